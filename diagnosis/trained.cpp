#include "diagnosis/trained.hpp"

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

}  // namespace

Trained::Trained(const EffectProblem& problem, const MatrixXd& free)
    : rows_(problem.training),
      allowed_(problem.precision(problem.training), columns_of(problem, free), deviations_of(problem, free)) {}

Trained::Trained(const EffectProblem& problem) : Trained(problem, MatrixXd(problem.residual.size(), 0)) {}

double Trained::misfit(const VectorXd& residual) const {
  const VectorXd r = rows(residual);
  return r.dot(allowed_(r).col(0));
}

VectorXd Trained::corrected(const EffectProblem& problem, const VectorXd& residual) const {
  return residual - problem.allowed * allowed_.amplitudes(rows(residual)).head(problem.allowed.cols());
}

Scores Trained::scores(const MatrixXd& changes, const VectorXd& residual) const {
  return scores_of(allowed_, rows(changes), rows(residual));
}

}  // namespace tether
