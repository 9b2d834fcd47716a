#pragma once

#include <set>
#include <string>
#include <vector>

#include "diagnosis/evidence/candidates.hpp"
#include "diagnosis/results/located_misfit.hpp"
#include "diagnosis/search/weighing.hpp"

namespace tether {

/// An effect on a patch of the wall that is worth a run, and the number of it that is to be varied; empty: all of them.
struct PatchEffect {
  PlacedEffect effect;
  std::string number;
};

/// Where what regions explain leaves a misfit: looks for the patch of the wall in which the law that explains most of
/// all explains most, from the misfit on, place by place, and then what other laws explain there. (D.25)
class PatchSearch {
 public:
  /// effects: the catalogue. length: the case's unit of it.
  PatchSearch(const std::vector<PlacedEffect>& effects, const LumenSurface& lumen, std::string length);

  /// What is worth runs now, each told once; none if the best patch was found and asked for all laws, or no patch
  /// explains as much as regions do. left: the largest misfit that what leads leaves, where the search begins.
  std::vector<PatchEffect> next(const EffectProblem& problem, const Weighing& weighing, const LocatedMisfit& left);

 private:
  enum class Stage { not_begun, moving, done };

  void begin(const EffectProblem& problem, const SetEvidence& evidence, const LocatedMisfit& left);
  /// Where the law explains most, if not much less than regions do.
  bool find_best(const EffectProblem& problem, const SetEvidence& evidence, const std::vector<std::size_t>& leading);
  /// Patches a step away, of the same size, and about the same place of other sizes, those that were not told yet.
  std::vector<PatchEffect> neighbours();
  std::vector<PatchEffect> other_laws();
  PatchEffect told(const std::string& type, const Ball& ball, const std::string& number);
  bool is_known(const Ball& ball) const;

  std::vector<PlacedEffect> laws_;  ///< that act on regions, one of each type
  const LumenSurface& lumen_;
  std::string length_;
  VectorXd areas_;  ///< of the lumen's nodes
  Stage stage_ = Stage::not_begun;
  std::string law_, number_;  ///< by which places are compared
  std::vector<Ball> told_;
  Ball best_;
  double step_ = 0;             ///< between places that are compared
  std::set<std::string> paths_;  ///< that are taken
};

}  // namespace tether
