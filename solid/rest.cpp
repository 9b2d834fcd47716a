#include "solid/rest.hpp"

#include <fmt/format.h>

#include "common/mesh/surface.hpp"
#include "solid/prestress.hpp"
#include "vessel/coordinates.hpp"

namespace tether {
namespace {

double largest(const VectorXd& forces) {
  return forces.size() > 0 ? forces.cwiseAbs().maxCoeff<Eigen::PropagateNaN>() : 0.0;
}

}  // namespace

HeldBySurroundings held_by_surroundings(const WallMesh& mesh, const InitialStress& initial, double pressure) {
  HeldBySurroundings held;
  held.share = initial.held_share;
  VectorXd area = VectorXd::Zero(mesh.points.cols());
  for (const Patch& region : mesh.outside) area += nodal_areas(mesh.points, region.triangles);
  for (const Patch& region : mesh.outside)
    for (const int node : nodes_of(region.triangles)) {
      const double here = initial.held.col(node).norm() / (area[node] * std::abs(pressure));
      if (here <= held.largest) continue;
      held.largest = here;
      held.place = mesh.points.col(node);
      held.region = region.name;
    }
  return held;
}

RestState rest_of(const WallModel& model, const ImageCase& image, const InitialStress* initial) {
  constexpr double moment = 1e-9;  // nothing moves: its length does not matter
  const Points& x = model.mesh().points;
  const Points still = Points::Zero(3, x.cols());
  const VectorXd pressure = uniform_pressure_forces(model.mesh(), x, image.pressure);
  VectorXd left = model.step_forces(still, still, still, 0, moment, nullptr);
  if (image.loads_wall()) left -= pressure;
  for (const int unknown : model.clamped_unknowns()) left[unknown] = 0;
  RestState rest{image.wall, {}, {}};
  if (image.pressure != 0) rest.residual = largest(left) / largest(pressure);
  if (initial != nullptr) rest.held = held_by_surroundings(model.mesh(), *initial, image.pressure);
  return rest;
}

std::string describe(const HeldBySurroundings& held) {
  return fmt::format(
      "prestress: in the imaged shape the wall's tension carries the image's pressure but for {:.1f} % of its forces, "
      "which the surroundings hold as a dead load; most, {:.2g} of the pressure, at {} in region {}{}",
      100 * held.share, held.largest, coordinates(held.place, 3), held.region,
      held.share > 0.25 ? "; that is much: is the lumen's surface rough, or the pressure too high?" : "");
}

}  // namespace tether
