#pragma once

#include "diagnosis/search/effect_tests.hpp"

namespace tether {

/// A model on the way: amplitudes, the residual that a run with them leaves, and how that changes.
struct AmplitudeState {
  VectorXd amplitudes;                ///< of all candidates [q]
  VectorXd residual;                  ///< [n]
  MatrixXd changes;                   ///< of -r per unit of each accepted effect's factor, at its amplitude [n x m]
  MatrixXd errors;                    ///< what mesh and step may make wrong in what was accepted: one deviation [n x k]
  std::vector<std::size_t> accepted;  ///< candidates that those columns are of [m]
};

/// A candidate on its way to the amplitudes with the smallest misfit: those to first order times a factor, while the
/// effects accepted before are refitted by factors too. Each run tells where to go next. (D.10)
class Refinement {
 public:
  /// error: of what the effect does at its amplitude, by mesh and step [n x 1], or nothing [n x 0]. (D.19)
  Refinement(TestedEffect effect, const AmplitudeState& from, const MatrixXd& error, const EffectProblem& problem);

  bool done() const { return done_; }
  bool begun() const { return last_ > 0; }
  int runs() const { return runs_; }
  /// Of the next run.
  VectorXd amplitudes() const { return at(next_, next_others_); }
  /// The run at `amplitudes` left this residual; NaN: it failed.
  void take(const VectorXd& residual);
  /// The smallest misfit so far, with what the freedom to err costs, and the one that it may come down to: before any
  /// run more is hoped for than first order promises.
  double best() const { return best_; }
  double hope() const;
  void give_up() { done_ = true; }
  /// What does the same to first order removes so much of the misfit: before any run no more is expected of this one.
  void expect_at_most(double gain) { expected_ = begun() ? expected_ : std::min(expected_, gain); }

  const TestedEffect& effect() const { return effect_; }
  /// At the best amplitudes, with this effect as the last of the accepted ones.
  AmplitudeState state() const;

 private:
  const std::vector<Eigen::Index>& own(std::size_t candidate) const {
    return problem_.candidates[candidate].amplitudes;
  }
  VectorXd at(double factor, const VectorXd& others) const;
  /// How far the accepted effects' factors move, in logarithms, if the residual were this.
  VectorXd others_for(const VectorXd& residual) const;
  void retreat();
  double first_step(const VectorXd& change, const VectorXd& now);
  double later_step(const VectorXd& now);

  TestedEffect effect_;
  const AmplitudeState& from_;
  const EffectProblem& problem_;
  MatrixXd errors_;                ///< of those accepted before, and of this one
  Trained trained_, plain_;        ///< with the accepted effects' changes free, and without
  double cost_ = 0;                ///< of the freedom to err
  VectorXd direction_;             ///< amplitudes at factor 1 [q]
  VectorXd first_order_;           ///< change of -r to first order at factor 1 [n]
  VectorXd per_factor_;            ///< change of -r per logarithm of the factor, by the last runs [n]
  double next_ = 1, last_ = 0;     ///< factors
  double farthest_ = infinite;     ///< factor beyond which an amplitude is not admissible
  VectorXd next_others_, others_;  ///< logarithms of the accepted effects' factors, next and last [m]
  VectorXd residual_;              ///< of the last run
  double bends_ = 0;               ///< c of f/(1 + c f), which the effect follows
  double best_factor_ = 0;
  VectorXd best_others_, best_residual_;
  double start_ = 0, best_ = 0, expected_ = 0;
  int runs_ = 0, failures_ = 0;
  bool done_ = false;
};

/// Amplitudes and deviations of those accepted first, as they are beside the later ones; scores: of what all do in the
/// state.
void take_beside_each_other(std::vector<TestedEffect>& effects, const AmplitudeState& state, const Scores& scores,
                            double dispersion, const EffectProblem& problem);

constexpr double hopeless = 12;  ///< of the misfit, behind the best

/// That any of them came down to so far.
double smallest_misfit(const std::vector<const Refinement*>& all);
/// Those that cannot come as near to the best as rivals must; best: that is known beside theirs.
void give_up_hopeless(std::vector<Refinement>& all, double best);
/// What explains less together with what was accepted, by more than rivals may, comes last.
void put_first_what_runs_ask_for(std::vector<const Refinement*>& all);

}  // namespace tether
