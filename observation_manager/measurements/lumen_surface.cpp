#include "observation_manager/measurements/lumen_surface.hpp"

#include <limits>
#include <set>

#include "common/mesh/locator.hpp"
#include "common/mesh/surface.hpp"

namespace tether {
namespace {

std::vector<int> regions_of(const Points& points, const WallMesh& wall) {
  std::vector<int> region;
  std::size_t count = 0;
  for (const Patch& patch : wall.outside) count += patch.triangles.size();
  Points centres(3, static_cast<Eigen::Index>(count));
  for (std::size_t r = 0; r < wall.outside.size(); ++r)
    for (const Triangle& t : wall.outside[r].triangles) {
      centres.col(static_cast<Eigen::Index>(region.size())) = wall.points(Eigen::all, t).rowwise().mean();
      region.push_back(static_cast<int>(r));
    }
  const PointLocator locator(centres);
  std::vector<int> result;
  for (const auto& x : points.colwise())
    result.push_back(count == 0 ? -1 : region[static_cast<std::size_t>(locator.nearest(x).node)]);
  return result;
}

/// Distance of each point to the nearest node that the end faces share with the interface; infinite without end faces.
VectorXd distance_to_rims(const Points& points, const FluidMesh& fluid, const std::vector<Patch>& ends) {
  const std::vector<int> nodes = nodes_of(fluid.interface);
  const std::set<int> on_interface(nodes.begin(), nodes.end());
  std::vector<int> rim;
  for (const Patch& end : ends)
    for (const int node : nodes_of(end.triangles))
      if (on_interface.contains(node)) rim.push_back(node);
  VectorXd distances = VectorXd::Constant(points.cols(), std::numeric_limits<double>::infinity());
  if (rim.empty()) return distances;
  const PointLocator locator(fluid.points(Eigen::all, rim));
  for (Eigen::Index i = 0; i < points.cols(); ++i) distances[i] = locator.nearest(points.col(i)).distance;
  return distances;
}

}  // namespace

LumenSurface lumen_of(const VesselMesh& vessel) {
  LumenSurface lumen;
  lumen.points = vessel.wall.points.leftCols(vessel.wall.interface_nodes);
  lumen.triangles = vessel.wall.interface;
  for (const Patch& patch : vessel.wall.outside) lumen.region_names.push_back(patch.name);
  lumen.region = regions_of(lumen.points, vessel.wall);
  lumen.from_inlet = distance_to_rims(lumen.points, vessel.fluid, vessel.fluid.inlets);
  lumen.from_outlet = distance_to_rims(lumen.points, vessel.fluid, vessel.fluid.outlets);
  return lumen;
}

VectorXd nodal_areas(const LumenSurface& lumen) {
  return nodal_areas(lumen.points, lumen.triangles);
}

Points nodal_normals(const LumenSurface& lumen) {
  return nodal_normals(lumen.points, lumen.triangles);
}

}  // namespace tether
