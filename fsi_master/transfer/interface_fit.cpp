#include "fsi_master/transfer/interface_fit.hpp"

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"
#include "fsi_master/transfer/followed_place.hpp"

namespace tether {

InterfaceFit interface_fit(const InterfaceSurface& fluid, const InterfaceSurface& solid, double trust) {
  InterfaceFit fit;
  fit.fluid_nodes = static_cast<int>(fluid.points.cols());
  fit.wall_nodes = static_cast<int>(solid.points.cols());
  if (fluid.triangles.empty() || solid.triangles.empty()) return fit;
  const TriangleLocator of_solid(solid.points, solid.triangles), of_fluid(fluid.points, fluid.triangles);
  const VectorXd fluid_areas = nodal_areas(fluid), solid_areas = nodal_areas(solid);
  fit.fluid_area = fluid_areas.sum();
  fit.wall_area = solid_areas.sum();
  double squares = 0;
  for (int node = 0; node < fluid.points.cols(); ++node) {
    const NearestPlace nearest = nearest_place(of_solid, fluid.points.col(node));
    const double inside = -nearest.place.height;  // the normals point out of the fluid
    fit.largest_gap = std::max(fit.largest_gap, inside);
    fit.largest_overlap = std::max(fit.largest_overlap, -inside);
    squares += fluid_areas(node) * nearest.distance * nearest.distance;
  }
  fit.rms_distance = std::sqrt(squares / fit.fluid_area);
  for (int node = 0; node < solid.points.cols(); ++node)
    if (of_fluid.nearest(solid.points.col(node)).distance > trust) fit.bare_area += solid_areas(node);
  for (const Triangle& t : fluid.triangles) {
    const Vec3 area = area_vector(fluid.points, t), middle = fluid.points(Eigen::all, t).rowwise().mean();
    const int nearest = of_solid.nearest(middle).triangle;
    const Vec3 beside = area_vector(solid.points, solid.triangles[static_cast<std::size_t>(nearest)]);
    if (area.dot(beside) < 0) fit.against_area += area.norm();
  }
  return fit;
}

std::string in_words(const InterfaceFit& fit, const UnitSystem& units) {
  std::string text = fmt::format(
      "{} nodes of the fluid, {} of the wall, which lies up to {:.2g} mm outside and {:.2g} mm inside the fluid's "
      "surface "
      "({:.2g} mm in the mean of squares)",
      fit.fluid_nodes, fit.wall_nodes, units.to_mm(fit.largest_gap), units.to_mm(fit.largest_overlap),
      units.to_mm(fit.rms_distance));
  if (fit.bare_share() > 0.01)
    text += fmt::format("; {:.0f} % of the wall has no fluid beside it, and no load", 100 * fit.bare_share());
  return text;
}

}  // namespace tether
