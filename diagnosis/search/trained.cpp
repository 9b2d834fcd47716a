#include "diagnosis/search/trained.hpp"

namespace tether {
namespace {

MatrixXd columns_of(const EffectProblem& problem, const MatrixXd& free) {
  MatrixXd columns(problem.training.size(), problem.allowed.cols() + free.cols());
  columns << problem.allowed(problem.training, Eigen::all), free(problem.training, Eigen::all);
  return columns;
}

VectorXd deviations_of(const EffectProblem& problem, const MatrixXd& free) {
  VectorXd deviations(problem.allowed.cols() + free.cols());
  deviations << problem.allowed_deviation, VectorXd::Constant(free.cols(), infinite);
  return deviations;
}

std::vector<Eigen::Index> all_rows(const EffectProblem& problem) {
  std::vector<Eigen::Index> rows = problem.training;
  rows.insert(rows.end(), problem.held_out.begin(), problem.held_out.end());
  return rows;
}

}  // namespace

Trained::Trained(const EffectProblem& problem, const MatrixXd& free)
    : rows_(problem.training),
      allowed_(problem.precision(problem.training), columns_of(problem, free), deviations_of(problem, free)) {}

Trained::Trained(const EffectProblem& problem) : Trained(problem, MatrixXd(problem.residual.size(), 0)) {}

double Trained::misfit(const VectorXd& residual) const {
  const VectorXd r = rows(residual);
  return r.dot(allowed_(r).col(0));
}

Scores Trained::scores(const MatrixXd& changes, const VectorXd& residual) const {
  return scores_of(allowed_, rows(changes), rows(residual));
}

Foretold::Foretold(const EffectProblem& problem)
    : problem_(problem),
      trained_(problem),
      rows_(all_rows(problem)),
      everywhere_(problem.precision(rows_), problem.allowed(rows_, Eigen::all), problem.allowed_deviation) {}

/// With the conditional mean taken off, the held-out part u has the precision M_hh, and M_hh u is that part of M r.
VectorXd Foretold::misfit(const VectorXd& residual) const {
  const auto& held_out = problem_.held_out;
  const VectorXd left = residual(held_out) - problem_.allowed(held_out, Eigen::all) * trained_.amplitudes(residual);
  const VectorXd r = residual(rows_), weighted = everywhere_(r).col(0);
  return left.cwiseProduct(weighted.tail(left.size()));
}

}  // namespace tether
