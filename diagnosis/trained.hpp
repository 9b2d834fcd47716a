#pragma once

#include "diagnosis/effect_problem.hpp"

namespace tether {

/// The training part of a problem, with its allowed errors taken out, and more directions if some may be anything.
class Trained {
 public:
  /// free: directions that the data may be off in by any amount, on all rows [n x m].
  Trained(const EffectProblem& problem, const MatrixXd& free);
  explicit Trained(const EffectProblem& problem);

  VectorXd rows(const VectorXd& all) const { return all(rows_); }
  MatrixXd rows(const MatrixXd& all) const { return all(rows_, Eigen::all); }
  const AllowedErrors& allowed() const { return allowed_; }
  /// r'M r of a residual on all rows.
  double misfit(const VectorXd& residual) const;
  /// A residual on all rows without the allowed errors that the training part shows. (D.13)
  VectorXd corrected(const EffectProblem& problem, const VectorXd& residual) const;
  /// S'M S and S'M r of changes and a residual on all rows.
  Scores scores(const MatrixXd& changes, const VectorXd& residual) const;

 private:
  std::vector<Eigen::Index> rows_;
  AllowedErrors allowed_;
};

}  // namespace tether
