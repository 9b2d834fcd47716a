#include "solid/prestress.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <deque>

#include "common/base/error.hpp"
#include "common/linalg/symmetric_solver.hpp"
#include "solid/wall_share.hpp"

namespace tether {
namespace {

/// Anderson acceleration of x <- x + g(x): the combination of the last steps whose g is smallest.
class Anderson {
 public:
  VectorXd next(const VectorXd& x, const VectorXd& g) {
    if (last_x_.size() > 0) {
      dx_.push_front(x - last_x_);
      dg_.push_front(g - last_g_);
      if (dx_.size() > depth) dx_.pop_back(), dg_.pop_back();
    }
    last_x_ = x;
    last_g_ = g;
    VectorXd result = x + g;
    if (dx_.empty()) return result;
    Eigen::MatrixXd differences(g.size(), static_cast<Eigen::Index>(dg_.size()));
    for (std::size_t k = 0; k < dg_.size(); ++k) differences.col(static_cast<Eigen::Index>(k)) = dg_[k];
    const VectorXd weights = differences.colPivHouseholderQr().solve(g);
    for (std::size_t k = 0; k < dg_.size(); ++k) result -= weights[static_cast<Eigen::Index>(k)] * (dx_[k] + dg_[k]);
    return result;
  }

 private:
  static constexpr std::size_t depth = 6;
  std::deque<VectorXd> dx_, dg_;
  VectorXd last_x_, last_g_;
};

double size_of(const Points& points) {
  return 0.5 * (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).minCoeff();
}

/// The iteration at one pressure, from a wall nearly free of stress there. Fails rather than leave the region where the
/// wall is stable.
StressFreeResult search(const WallMesh& mesh, const Material& material, const VectorXd& load,
                        const std::vector<int>& fixed, const Share& share, const Points& start, double tolerance) {
  constexpr int max_iterations = 80;
  const double size = size_of(mesh.points);
  StressFreeResult result;
  result.positions = start;
  Anderson anderson;
  const std::unique_ptr<SymmetricSolver> solver = symmetric_solver(share);
  while (result.iterations < max_iterations) {
    const auto wall = make_wall_elements(mesh, result.positions, share);
    VectorXd out_of_balance = VectorXd::Zero(load.size());
    SparseMatrix tangent = wall->zero_matrix();
    wall->static_force(mesh.points, material, out_of_balance, &tangent);
    constrain(tangent, fixed, first_entry(share, tangent));
    if (result.iterations == 0) solver->analyze(tangent, 3);
    if (!solver->factor_if_definite(tangent)) {
      result.failure = "the wall is not stable under tension and bending as they would have to be: it buckles";
      return result;
    }
    out_of_balance = load - out_of_balance;
    for (int unknown : fixed) out_of_balance[unknown] = 0;
    const VectorXd step = -solver->solve(out_of_balance);
    ++result.iterations;
    result.residual = step.lpNorm<Eigen::Infinity>() / size;
    result.converged = result.residual <= tolerance;
    if (result.converged || !std::isfinite(result.residual)) break;
    const VectorXd next = anderson.next(result.positions.reshaped(), step);
    result.positions.reshaped() = next;
  }
  if (!result.converged)
    result.failure = std::isfinite(result.residual)
                         ? fmt::format("{} iterations end with corrections of {:.2g} of the size", result.iterations,
                                       result.residual)
                         : "the corrections grow without bound";
  return result;
}

}  // namespace

VectorXd uniform_pressure_forces(const WallMesh& mesh, const Points& x, double pressure) {
  VectorXd forces = VectorXd::Zero(x.size());
  for (const Triangle& t : mesh.interface) {
    const Vec3 share = pressure / 6 * (x.col(t[1]) - x.col(t[0])).cross(x.col(t[2]) - x.col(t[0]));
    for (int node : t) forces.segment<3>(3 * node) += share;
  }
  return forces;
}

StressFreeResult stress_free_configuration(const WallMesh& mesh, const Material& material, double pressure,
                                           const std::vector<int>& fixed, const Share& share, double tolerance) {
  constexpr double smallest_increment = 1.0 / 512, tolerance_on_the_way = 1e-3;
  const VectorXd load = uniform_pressure_forces(mesh, mesh.points, pressure);
  StressFreeResult result;
  result.positions = mesh.points;
  if (fixed.empty()) {
    result.failure =
        "no end of the wall is clamped or driven, so that nothing carries what the pressure exerts along it";
    return result;
  }
  double increment = 0.125;
  while (result.reached < 1 && increment >= smallest_increment) {
    const double target = std::min(1.0, result.reached + increment);
    StressFreeResult next;
    try {
      next = search(mesh, material, target * load, fixed, share, result.positions,
                    target < 1 ? tolerance_on_the_way : tolerance);
    } catch (const RunError& error) {  // an element without volume: the step was too long
      next.failure = error.what();
    }
    result.iterations += next.iterations;
    result.residual = next.residual;
    result.failure = next.failure;
    increment *= next.converged ? 1.5 : 0.5;
    if (!next.converged) continue;
    result.positions = next.positions;
    result.reached = target;
  }
  result.converged = result.reached >= 1;
  return result;
}

}  // namespace tether
