#pragma once

#include "diagnosis/search/refinement.hpp"
#include "diagnosis/search/weighing.hpp"

namespace tether {

/// Runs that find the amplitudes of candidates which compete for one place: always those of the ones that promise most,
/// until none of the others can come as near to the best as a rival must.
class Race {
 public:
  /// shown: runs that were made, at finite size.
  Race(const EffectProblem& problem, const SearchSettings& settings, const ResidualAt& residual_at,
       std::vector<ShownRun>& shown)
      : problem_(problem), settings_(settings), residual_at_(residual_at), shown_(shown) {}

  /// scores, misfit: of the model on the way, beside which they are refined. near: what they must come near to as well.
  void run(std::vector<Refinement>& all, const Scores& scores, double misfit, double near);

 private:
  void run_once(const std::vector<Refinement*>& open);

  const EffectProblem& problem_;
  const SearchSettings& settings_;
  const ResidualAt& residual_at_;
  std::vector<ShownRun>& shown_;
};

}  // namespace tether
