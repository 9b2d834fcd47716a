#pragma once

#include <map>

#include "diagnosis/evidence/diagnosed_case.hpp"
#include "diagnosis/evidence/whitening.hpp"

namespace tether {

/// Runs of the model at finite amplitudes, each made once.
class Trials {
 public:
  /// problem: of the whitened data. base: the run of the model as it is; of a coarser model than that of which the
  /// problem is, what it does otherwise than the model is taken off all its runs.
  Trials(const EffectProblem& problem, const Evidence& evidence, const Whitening& whitening, const FinishedMotion& base,
         ModelRuns& runs);

  /// The residuals with these amplitudes, a column each; errors of the data are added to first order, which is exact
  /// for most. NaN where the model does not come to its end.
  MatrixXd residual_at(const MatrixXd& amplitudes);
  /// Of amplitudes that were run before.
  VectorXd residual_with(const VectorXd& amplitudes) const;
  const FinishedMotion& motion_with(const VectorXd& amplitudes) const;
  /// The run with these amplitudes; null if there is none.
  const FinishedMotion* find(const VectorXd& amplitudes) const;
  /// Amplitudes of the runs of a candidate of one number by itself.
  std::vector<double> sizes_of(std::size_t candidate) const;

 private:
  struct Trial {
    FinishedMotion motion;
    VectorXd residual;
    VectorXd amplitudes;  ///< [q]
  };
  /// What the model's numbers are then, those that differ.
  NamedValues values_of(const VectorXd& amplitudes) const;
  void provide(const MatrixXd& amplitudes);

  const EffectProblem& problem_;
  const Evidence& evidence_;
  const Whitening& whitening_;
  VectorXd base_;   ///< data minus the model as it is, not whitened [n]
  VectorXd shift_;  ///< from the residuals of these runs to those of the problem's model [n]
  ModelRuns& runs_;
  std::map<NamedValues, Trial> known_;
  int count_ = 0;
};

}  // namespace tether
