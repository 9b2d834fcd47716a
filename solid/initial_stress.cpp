#include "solid/initial_stress.hpp"

#include "common/linalg/symmetric_solver.hpp"
#include "common/mesh/surface.hpp"
#include "solid/inflation_stiffness.hpp"
#include "solid/prestress.hpp"

namespace tether {
namespace {

/// Own rows of the matrix += k M_b, lumped.
void add_tissue(const WallMesh& mesh, double k, const Share& share, SparseMatrix& matrix) {
  for (const Patch& region : mesh.outside)
    for (const Triangle& t : region.triangles) {
      const double part = k * area_vector(mesh.points, t).norm() / 3;
      for (int node : t)
        for (int i = 0; share.is_own(node) && i < 3; ++i) matrix.coeffRef(3 * node + i, 3 * node + i) += part;
    }
}

double sum_of_magnitudes(const Points& forces) {
  return forces.colwise().norm().sum();
}

}  // namespace

InitialStress find_initial_stress(const WallMesh& mesh, const Material& material, double pressure, const Share& share) {
  constexpr int steps = 10;  // tension is then right to 2^-10
  const auto wall = make_wall_elements(mesh, mesh.points, share);
  VectorXd none = VectorXd::Zero(mesh.points.size());
  SparseMatrix K = wall->zero_matrix();
  wall->static_force(mesh.points, material, none, &K);
  SparseMatrix damped = K;
  add_tissue(mesh, inflation_stiffness(mesh, *wall, material), share, damped);
  const std::unique_ptr<SymmetricSolver> factor = symmetric_solver(share);
  factor->analyze(damped, 3);
  factor->factor(damped);

  const VectorXd load = uniform_pressure_forces(mesh, mesh.points, pressure);
  VectorXd u = VectorXd::Zero(load.size()), remaining = load;
  for (int step = 0; step < steps; ++step) {
    u += factor->solve(remaining);
    remaining = K * u;
    share.complete(remaining);
    remaining = load - remaining;
  }
  InitialStress result;
  result.virtual_displacement = u.reshaped(3, mesh.points.cols());
  result.held = -remaining.reshaped(3, mesh.points.cols());
  result.held_share = sum_of_magnitudes(result.held) / sum_of_magnitudes(load.reshaped(3, mesh.points.cols()));
  return result;
}

}  // namespace tether
