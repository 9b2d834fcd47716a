#pragma once

#include <set>
#include <vector>

#include "diagnosis/evidence/candidates.hpp"
#include "diagnosis/search/posterior.hpp"

namespace tether {

/// Whether what is probable acts in all of its place or in a part of it: candidates that are run only where the data
/// already ask for something there.
class Division {
 public:
  /// all: of the model with all candidates; those of parts are kept here.
  Division(const std::vector<PlacedEffect>& effects, const std::vector<VariedNumber>& all);

  /// Numbers of effects that act in all of their place, or that the model has, and the wall's stiffness in either half
  /// of the vessel.
  const std::vector<VariedNumber>& undivided() const { return undivided_; }
  /// Numbers of parts that are worth a run now, each told once: the parts of what leads a probable group; of what does
  /// the same in all of the place the part in which that leads. Where something is missing that no candidate is, groups
  /// that lead count as probable.
  std::vector<VariedNumber> next(const EffectProblem& problem, const Weighed& weighed, const SetEvidence& evidence);

 private:
  struct Part {
    VariedNumber number;
    const PlacedEffect* effect;
  };
  bool divides(const Part& part, const Candidate& candidate) const;

  std::vector<VariedNumber> undivided_;
  std::vector<Part> parts_;
  std::set<std::string> told_;  ///< names of numbers
};

}  // namespace tether
