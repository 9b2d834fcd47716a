#include "fsi_master/convergence.hpp"

#include <cmath>
#include <limits>

namespace tether {
namespace {

constexpr double just_enough = 0.3;        // share of what will be left anyway, that a linear solve may leave
constexpr double useful = 0.1;             // most that a linear solve may leave for its answer to be taken
constexpr double correction_share = 0.01;  // of r, that the correction will at least have

/// One that is not finite, if there is any; none if none is finite, which says nothing of a place.
int largest_node(const VectorXd& values) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const Eigen::ArrayXd lengths = values.reshaped(3, values.size() / 3).colwise().norm();
  Eigen::Index largest = -1;
  if (lengths.isFinite().any()) lengths.isFinite().select(lengths, infinite).maxCoeff(&largest);
  return static_cast<int>(largest);
}

}  // namespace

Convergence::Convergence(const CouplingOptions& options, const StepStart& start)
    : options_(options),
      floor_(1e-12 * options.size / start.dt * std::sqrt(static_cast<double>(start.displacement.size()) / 3.0)) {}

bool Convergence::may_continue() const {
  return result_.failure.empty() && !result_.converged && result_.evaluations < options_.max_iterations;
}

double Convergence::target(const VectorXd& V, const VectorXd& residual) const {
  return std::max(floor_, options_.tolerance * std::max(V.norm(), (V + residual).norm()));
}

double Convergence::linear_target(const VectorXd& V, const VectorXd& residual, double left) const {
  const double wanted = std::max(floor_, options_.tolerance * std::max(V.norm(), correction_share * residual.norm()));
  return just_enough * std::max(wanted, left);  // (C.5)
}

void Convergence::note(const KrylovResult& solve) {
  result_.krylov_iterations += solve.iterations;
  if (solve.converged || solve.residual <= useful || !result_.failure.empty()) return;
  result_.failure = fmt::format("the linear equations of a correction kept {:.2g} of their residual in {} iterations",
                                solve.residual, solve.iterations);
}

bool Convergence::is_same(const VectorXd& velocity, const VectorXd& V) const {
  return (velocity - V).norm() <= just_enough * std::max(floor_, options_.tolerance * V.norm());
}

bool Convergence::reached(const VectorXd& V, const VectorXd& residual) {
  const double norm = residual.norm(), scale = std::max(V.norm(), (V + residual).norm());
  ++result_.evaluations;
  result_.residuals.push_back(scale > 0 ? norm / scale : norm);
  result_.worst_node = largest_node(residual);
  if (!std::isfinite(norm))  // of numbers beyond 1e154 too
    result_.failure = fmt::format("a partner answered with numbers that are {}",
                                  residual.allFinite() ? "too large to be squared" : "not finite");
  result_.converged = result_.failure.empty() && norm <= target(V, residual);  // (C.3)
  return result_.converged;
}

CouplingResult Convergence::result(Motion motion) && {
  result_.motion = std::move(motion);
  if (!result_.converged && result_.failure.empty())
    result_.failure = fmt::format("not converged to {} after {} evaluations", options_.tolerance, result_.evaluations);
  return std::move(result_);
}

}  // namespace tether
