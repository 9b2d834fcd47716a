#pragma once

#include "diagnosis/evidence/effect_problem.hpp"

namespace tether {

/// The training part of a problem, with its allowed errors taken out, and more directions if some may be anything.
class Trained {
 public:
  /// free: directions that the data may be off in by any amount, on all rows [n x m]; errors: by a deviation of 1.
  Trained(const EffectProblem& problem, const MatrixXd& free, const MatrixXd& errors);
  Trained(const EffectProblem& problem, const MatrixXd& free);
  explicit Trained(const EffectProblem& problem);

  VectorXd rows(const VectorXd& all) const { return all(rows_); }
  MatrixXd rows(const MatrixXd& all) const { return all(rows_, Eigen::all); }
  const AllowedErrors& allowed() const { return allowed_; }
  /// r'M r of a residual on all rows.
  double misfit(const VectorXd& residual) const;
  /// The same where data may be off along one more column too, by a deviation of 1, with what that freedom costs: of
  /// twice the negative logarithm of their probability the part that changes.
  double misfit(const VectorXd& residual, const VectorXd& error) const;
  /// That cost: by what factor more the data may vary along the column, as a logarithm.
  double cost(const VectorXd& error) const;
  /// The same of the data that count as independent ones, of which noise makes as much as there are.
  double counted_misfit(const VectorXd& residual) const;
  /// The amplitudes of the problem's allowed errors that the training part of a residual on all rows shows [k].
  VectorXd amplitudes(const VectorXd& residual) const { return allowed_.amplitudes(rows(residual)); }
  /// S'M S and S'M r of changes and a residual on all rows, with the counted misfit.
  Scores scores(const MatrixXd& changes, const VectorXd& residual) const;

 private:
  std::vector<Eigen::Index> rows_, counted_rows_;
  AllowedErrors allowed_, counted_;
};

/// The problem of the data that count as independent ones alone.
EffectProblem counted(EffectProblem problem);

/// The problem trained on all data that may name something.
EffectProblem naming(EffectProblem problem);

/// Held-out data as training data and allowed errors foretell them: what they still miss. (D.13)
class Foretold {
 public:
  explicit Foretold(const EffectProblem& problem);

  /// Each held-out datum's part of r'M r over all data less that over the training data alone [held-out].
  VectorXd misfit(const VectorXd& residual) const;

 private:
  const EffectProblem& problem_;
  Trained trained_;
  std::vector<Eigen::Index> rows_;  ///< training, then held out
  AllowedErrors everywhere_;
};

}  // namespace tether
