#include "vessel/model/vessel_model.hpp"

#include <algorithm>

#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"
#include "vessel/check.hpp"
#include "vessel/grown_wall.hpp"
#include "vessel/growth/prism_shape.hpp"
#include "vessel/volume/tetrahedra.hpp"

namespace tether {

namespace {

constexpr double poor_radius_ratio = 0.1, poor_jacobian = 0.2, thinner = 0.95;

ExtrusionSettings extrusion_on(const Anatomy& anatomy, const GrownWallCase& given) {
  ExtrusionSettings settings = extrusion_of(given);
  settings.field = "model.wall.thickness";
  settings.varying = [tree = thickness_of(given), &anatomy](const Points& places) {
    return thickness_at(places, tree, anatomy);
  };
  return settings;
}

TetrahedraQuality blood_quality(const FluidMesh& fluid) {
  const Quality shape = quality(fluid.points, fluid.tetrahedra);
  TetrahedraQuality result;
  result.nodes = static_cast<int>(fluid.points.cols());
  result.elements = static_cast<int>(fluid.tetrahedra.size());
  for (const Tetrahedron& t : fluid.tetrahedra) result.volume += signed_volume(fluid.points, t);
  result.least_radius_ratio = shape.min_radius_ratio;
  result.mean_radius_ratio = shape.mean_radius_ratio;
  result.least_dihedral = shape.min_dihedral;
  if (shape.worst >= 0)
    result.worst_place =
        fluid.points(Eigen::all, fluid.tetrahedra[static_cast<std::size_t>(shape.worst)]).rowwise().mean();
  return result;
}

PrismsQuality prisms_quality(const WallMesh& wall, const VectorXd& thickness) {
  PrismsQuality result;
  result.nodes = static_cast<int>(wall.points.cols());
  result.elements = static_cast<int>(wall.prisms.size());
  result.layers = result.nodes / wall.interface_nodes - 1;
  for (const Tetrahedron& t : split_into_tetrahedra(wall.prisms)) result.volume += signed_volume(wall.points, t);
  result.least_jacobian = 1;
  const int top = result.layers * wall.interface_nodes;
  for (const Triangle& t : wall.interface) {
    const PrismShape shape(wall.points(Eigen::all, t), thickness(t));
    const double worst = shape.worst(wall.points(Eigen::all, Triangle{t[0] + top, t[1] + top, t[2] + top}));
    if (worst >= result.least_jacobian) continue;
    result.least_jacobian = worst;
    result.worst_place = wall.points(Eigen::all, t).rowwise().mean();
  }
  return result;
}

ThicknessQuality thickness_quality(const GrownWall& growth, const WallMesh& wall) {
  ThicknessQuality result{growth.asked.minCoeff(), growth.asked.maxCoeff(), growth.thickness.minCoeff(),
                          growth.thickness.mean(), growth.thickness.maxCoeff()};
  const VectorXd share = growth.thickness.cwiseQuotient(growth.asked);
  Eigen::Index thinnest = 0;
  result.least_share = share.minCoeff(&thinnest);
  result.thinnest_place = wall.points.col(thinnest);
  for (const Triangle& t : wall.interface)
    for (const int node : t)
      if (share[node] < thinner) result.thinner_area += area_vector(wall.points, t).norm() / 3;
  result.moved_nodes = growth.moved;
  return result;
}

std::string place(const Vec3& x) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", x[0], x[1], x[2]);
}

std::vector<std::string> warnings_of(const ModelQuality& q) {
  std::vector<std::string> warnings;
  if (q.blood.least_radius_ratio < poor_radius_ratio)
    warnings.push_back(fmt::format("a tetrahedron of the blood near {} is nearly flat: radius ratio {:.2g}",
                                   place(q.blood.worst_place), q.blood.least_radius_ratio));
  if (q.wall.least_jacobian < poor_jacobian)
    warnings.push_back(
        fmt::format("a prism of the wall near {} is nearly folded (Jacobian {:.2g}), and may give way as "
                    "the model runs: ask for shorter edges or less thickness there",
                    place(q.wall.worst_place), q.wall.least_jacobian));
  if (q.thickness.least_share < thinner)
    warnings.push_back(fmt::format("the wall is thinner than asked on {:.3g} {}2, most near {}: {:.0f} % of it",
                                   q.thickness.thinner_area, q.unit, place(q.thickness.thinnest_place),
                                   100 * q.thickness.least_share));
  return warnings;
}

ModelQuality quality_of(const VesselModel& model, const UnitSystem& units) {
  ModelQuality result;
  result.unit = units.symbol(dimension::length);
  result.blood = blood_quality(model.mesh.fluid);
  result.wall = prisms_quality(model.mesh.wall, model.growth.thickness);
  result.thickness = thickness_quality(model.growth, model.mesh.wall);
  for (const Patch& region : model.mesh.wall.outside)
    result.regions.push_back({region.name, area_of(model.mesh.wall.points, region)});
  result.warnings = warnings_of(result);
  return result;
}

}  // namespace

void VolumeCase::declare(Fields& f) {
  f.number("longest_edge", longest_edge, dimension::length, range::positive,
           "of tetrahedra inside the lumen; default: as on its surface");
  f.group("wall", wall, "grown outward on the lumen's surface");
  f.groups("regions", regions, "of the outer wall by geometry, by name: the first that contains a place takes it");
}

VesselModel build_model(const LabelledSurface& surface, const CentrelineTree& tree, const VolumeCase& study,
                        const UnitSystem& units) {
  const Anatomy anatomy(tree);
  VesselModel model;
  model.mesh.fluid = fill_with_tetrahedra(surface, study.longest_edge);
  model.growth = grow_wall(model.mesh.fluid, extrusion_on(anatomy, study.wall));
  WallMesh& wall = model.mesh.wall = std::move(model.growth.wall);
  if (!study.regions.empty())
    wall.outside = divide_by_rules(
        wall.points, wall.outside.front().triangles,
        rules_of(study.regions, &anatomy, units, [](const std::string& name) { return "model.regions." + name; }),
        &anatomy);
  check(model.mesh, units, "model.wall");
  model.quality = quality_of(model, units);
  return model;
}

}  // namespace tether
