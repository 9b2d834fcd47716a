#pragma once

#include "diagnosis/evidence/effect_problem.hpp"
#include "diagnosis/evidence/evidence.hpp"

namespace tether {

/// Noise whose size the data may tell by itself: of a source, waves of more than half the longest's variance and
/// others.
struct NoiseBand {
  std::size_t source = 0;
  bool is_long = false;
  auto operator<=>(const NoiseBand&) const = default;
};

/// Data as numbers whose errors are independent and of deviation 1: combinations of the data of a frame or record that
/// err together, longest waves first, then freed of what earlier moments tell of their errors. Waves so short that what
/// was stated of the noise hardly says how large they are stay out. Training data come first, so that of held-out data
/// is left what those do not foretell. (D.18)
class Whitening {
 public:
  /// problem: `evidence.problem()`.
  Whitening(const Evidence& evidence, const EffectProblem& problem);

  /// Of columns over the data [n x m] those over the combinations [k x m]; NaN stays in its column.
  MatrixXd operator()(const MatrixXd& data) const;
  /// The same problem in these numbers. `independent` is 1 where the noise's size is well known, else 0.
  EffectProblem operator()(EffectProblem problem) const;
  /// Of each combination [k].
  std::vector<NoiseBand> bands() const;
  /// Takes the noise of each combination for so much larger [k].
  void widen(const VectorXd& larger);

 private:
  /// Data that err together in space: a component of a frame, or values of a record, either used or held out.
  struct Group {
    std::vector<Eigen::Index> rows;
    bool held_out = false, sealed = false;
    std::size_t source = 0;
    int series = 0, component = 0, moment = 0;
    MatrixXd modes;          ///< [k x rows]
    VectorXd variance;       ///< of each over that of the longest wave [k]
    Eigen::Index first = 0;  ///< of its combinations among all
  };
  /// Groups that follow each other in time and whose errors last.
  struct Chain {
    std::vector<std::size_t> groups;
    MatrixXd factor;  ///< lower triangle of their combinations' covariance
  };

  void add_groups(const Evidence& evidence, const EffectProblem& problem, const std::vector<Eigen::Index>& rows,
                  bool held_out);
  void add_chains(const Evidence& evidence);
  MatrixXd covariance_of(const Evidence& evidence, const std::vector<std::size_t>& groups) const;

  std::vector<Group> groups_;  ///< training first
  std::vector<Chain> chains_;
  Eigen::Index count_ = 0;
};

}  // namespace tether
