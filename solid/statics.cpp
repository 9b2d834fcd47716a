#include "solid/statics.hpp"

#include "common/base/error.hpp"
#include "common/linalg/cholesky.hpp"

namespace tether {

StaticResult solve_static(const WallElements& wall, const Material& material, const Points& start,
                          const StaticLoad& load, const std::vector<int>& fixed, double tolerance, int max_iterations) {
  StaticResult result;
  result.positions = start;
  Cholesky cholesky;
  const Eigen::Index size = 3 * start.cols();
  while (result.iterations < max_iterations) {
    VectorXd internal = VectorXd::Zero(size), external = VectorXd::Zero(size);
    SparseMatrix tangent = wall.zero_matrix();
    wall.static_force(result.positions, material, internal, &tangent);
    load(result.positions, external, &tangent);
    VectorXd residual = external - internal;
    for (int unknown : fixed) residual[unknown] = 0;
    const double scale = std::max(external.lpNorm<Eigen::Infinity>(), 1e-300);
    result.residual = residual.lpNorm<Eigen::Infinity>() / scale;
    result.converged = result.residual <= tolerance;
    if (result.converged || !std::isfinite(result.residual)) break;
    constrain(tangent, fixed, tangent.coeff(0, 0));
    if (result.iterations == 0) cholesky.analyze(tangent, 3);
    if (!cholesky.factor_if_definite(tangent)) break;  // beyond a limit load, or too far from equilibrium
    result.positions.reshaped() += cholesky.solve(residual);
    ++result.iterations;
  }
  return result;
}

}  // namespace tether
