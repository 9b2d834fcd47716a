#include "solid/element_places.hpp"

#include <Eigen/Geometry>

#include "common/mesh/locator.hpp"
#include "solid/vessel_direction.hpp"

namespace tether {
namespace {

Points points_of(const std::vector<Vec3>& list) {
  return Eigen::Map<const Points>(list.front().data(), 3, static_cast<Eigen::Index>(list.size()));
}

template <std::size_t nodes>
Vec3 centre_of(const Points& x, const std::array<int, nodes>& cell) {
  Vec3 sum = Vec3::Zero();
  for (const int node : cell) sum += x.col(node);
  return sum / static_cast<double>(nodes);
}

/// The triangles of the outer wall, and where they are.
struct OuterWall {
  explicit OuterWall(const WallMesh& mesh, const VectorXd& along) {
    std::vector<Vec3> centres;
    for (std::size_t region = 0; region < mesh.outside.size(); ++region)
      for (const Triangle& t : mesh.outside[region].triangles) {
        Mat3 x;
        x << mesh.points.col(t[0]), mesh.points.col(t[1]), mesh.points.col(t[2]);
        const Vec3 outward = (x.col(1) - x.col(0)).cross(x.col(2) - x.col(0)).normalized();
        const Vec3 axial = along.size() == 0 ? Vec3::Zero() : direction_on(x, {along[t[0]], along[t[1]], along[t[2]]});
        places.push_back({static_cast<int>(region), outward, axial});
        centres.push_back(x.rowwise().mean());
      }
    locator.emplace(points_of(centres));
  }
  const ElementPlace& near(const Vec3& x) const { return places[static_cast<std::size_t>(locator->nearest(x).node)]; }

  std::vector<ElementPlace> places;
  std::optional<PointLocator> locator;
};

}  // namespace

std::vector<ElementPlace> element_places(const WallMesh& mesh, const VectorXd& along) {
  const OuterWall outside(mesh, along);
  std::vector<ElementPlace> result;
  for (const Prism& cell : mesh.prisms) result.push_back(outside.near(centre_of(mesh.points, cell)));
  for (const Tetrahedron& cell : mesh.tetrahedra) result.push_back(outside.near(centre_of(mesh.points, cell)));
  return result;
}

}  // namespace tether
