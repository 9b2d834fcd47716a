#include "solid/lumen_regions.hpp"

#include "common/mesh/locator.hpp"

namespace tether {
namespace {

Vec3 centre_of(const Points& x, const Triangle& t) {
  return (x.col(t[0]) + x.col(t[1]) + x.col(t[2])) / 3;
}

}  // namespace

std::vector<int> regions_of_interface(const WallMesh& mesh) {
  std::vector<int> region_of;
  std::vector<Vec3> centres;
  for (std::size_t region = 0; region < mesh.outside.size(); ++region)
    for (const Triangle& t : mesh.outside[region].triangles) {
      region_of.push_back(static_cast<int>(region));
      centres.push_back(centre_of(mesh.points, t));
    }
  const PointLocator locator(
      Eigen::Map<const Points>(centres.front().data(), 3, static_cast<Eigen::Index>(centres.size())));
  std::vector<int> result;
  for (const Triangle& t : mesh.interface)
    result.push_back(region_of[static_cast<std::size_t>(locator.nearest(centre_of(mesh.points, t)).node)]);
  return result;
}

}  // namespace tether
