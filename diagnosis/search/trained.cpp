#include "diagnosis/search/trained.hpp"

#include <cmath>

namespace tether {
namespace {

using Rows = std::vector<Eigen::Index>;

AllowedErrors allowed_errors(const EffectProblem& problem, const MatrixXd& free, const MatrixXd& errors,
                             const Rows& rows) {
  MatrixXd columns(rows.size(), problem.allowed.cols() + free.cols() + errors.cols());
  columns << problem.allowed(rows, Eigen::all), free(rows, Eigen::all), errors(rows, Eigen::all);
  VectorXd deviations(columns.cols());
  deviations << problem.allowed_deviation, VectorXd::Constant(free.cols(), infinite), VectorXd::Ones(errors.cols());
  return {problem.precision(rows), columns, deviations};
}

Rows counted_of(const EffectProblem& problem, Rows rows) {
  std::erase_if(rows, [&](Eigen::Index i) { return !(problem.independent(i) > 0); });
  return rows;
}

Rows all_rows(const EffectProblem& problem) {
  Rows rows = problem.training;
  rows.insert(rows.end(), problem.held_out.begin(), problem.held_out.end());
  return rows;
}

MatrixXd no_columns(const EffectProblem& problem) {
  return {problem.residual.size(), 0};
}

}  // namespace

Trained::Trained(const EffectProblem& problem, const MatrixXd& free, const MatrixXd& errors)
    : rows_(problem.training),
      counted_rows_(counted_of(problem, problem.training)),
      allowed_(allowed_errors(problem, free, errors, rows_)),
      counted_(allowed_errors(problem, free, errors, counted_rows_)) {}

Trained::Trained(const EffectProblem& problem, const MatrixXd& free) : Trained(problem, free, no_columns(problem)) {}

Trained::Trained(const EffectProblem& problem) : Trained(problem, no_columns(problem)) {}

double Trained::misfit(const VectorXd& residual) const {
  const VectorXd r = rows(residual);
  return r.dot(allowed_(r).col(0));
}

double Trained::cost(const VectorXd& error) const {
  const VectorXd e = rows(error);
  return std::log1p(e.dot(allowed_(e).col(0)));
}

double Trained::misfit(const VectorXd& residual, const VectorXd& error) const {
  const VectorXd r = rows(residual), e = rows(error), seen = allowed_(e).col(0);
  const double square = e.dot(seen), along = r.dot(seen);
  return misfit(residual) - along * along / (1 + square) + std::log1p(square);
}

double Trained::counted_misfit(const VectorXd& residual) const {
  const VectorXd r = residual(counted_rows_);
  return r.dot(counted_(r).col(0));
}

Scores Trained::scores(const MatrixXd& changes, const VectorXd& residual) const {
  Scores scores = scores_of(allowed_, rows(changes), rows(residual));
  scores.misfit = counted_misfit(residual);
  return scores;
}

EffectProblem counted(EffectProblem problem) {
  problem.training = counted_of(problem, problem.training);
  problem.held_out = counted_of(problem, problem.held_out);
  return problem;
}

EffectProblem naming(EffectProblem problem) {
  problem.training = naming_rows(problem);
  problem.held_out.clear();
  return problem;
}

Foretold::Foretold(const EffectProblem& problem)
    : problem_(problem),
      trained_(problem),
      rows_(all_rows(problem)),
      everywhere_(allowed_errors(problem, no_columns(problem), no_columns(problem), rows_)) {}

/// With the conditional mean taken off, the held-out part u has the precision M_hh, and M_hh u is that part of M r.
VectorXd Foretold::misfit(const VectorXd& residual) const {
  const auto& held_out = problem_.held_out;
  const VectorXd left = residual(held_out) - problem_.allowed(held_out, Eigen::all) * trained_.amplitudes(residual);
  const VectorXd r = residual(rows_), weighted = everywhere_(r).col(0);
  return left.cwiseProduct(weighted.tail(left.size()));
}

}  // namespace tether
