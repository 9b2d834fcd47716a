#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "diagnosis/evidence/candidates.hpp"
#include "diagnosis/results/patch_place.hpp"
#include "diagnosis/search/weighing.hpp"

namespace tether {

/// An effect on a patch of the wall that is worth a run, and which of its numbers are to be varied.
struct PatchEffect {
  PlacedEffect effect;
  std::string number, other_than = {};  ///< the only one; all others. Both empty: all
};

/// Where what regions explain leaves a misfit: looks for the patch of the wall in which the law that explains most of
/// all explains most, from the misfit on, place by place, and then what other laws explain there. (D.25)
class PatchSearch {
 public:
  /// effects: the catalogue. length: the case's unit of it.
  PatchSearch(const std::vector<PlacedEffect>& effects, const LumenSurface& lumen, std::string length);

  /// What is worth runs now, each told once; none if the best patch was found and asked for all laws, or no patch
  /// explains as much as regions do. starts: where the search begins.
  std::vector<PatchEffect> next(const EffectProblem& problem, const Weighing& weighing,
                                const std::vector<Ball>& starts);
  /// Where the law explains most; none if no patch explains as much as regions do.
  const std::optional<PatchPlace>& place() const { return place_; }

 private:
  enum class Stage { not_begun, moving, done };
  struct Tried {
    Ball ball;
    double evidence;  ///< its logarithm
  };

  void choose_law(const EffectProblem& problem, const SetEvidence& evidence);
  /// Patches that were run with the law.
  std::vector<Tried> tried(const EffectProblem& problem, const SetEvidence& evidence) const;
  void set_place(const std::vector<Tried>& all);
  /// Patches a step away, of the same size, and about the same place of other sizes, those that were not told yet.
  std::vector<PatchEffect> neighbours();
  std::vector<PatchEffect> other_laws();
  std::vector<PatchEffect> first_patches(const std::vector<Ball>& starts);
  PatchEffect told(const std::string& type, const Ball& ball, const std::string& number);
  bool is_known(const Ball& ball) const;

  std::vector<PlacedEffect> laws_;  ///< that act on regions, one of each type
  const LumenSurface& lumen_;
  std::string length_;
  VectorXd areas_;  ///< of the lumen's nodes
  Stage stage_ = Stage::not_begun;
  std::string law_, number_;          ///< by which places are compared
  std::vector<std::size_t> leading_;  ///< candidates that led before
  std::vector<Ball> told_;
  Ball best_;
  double step_ = 0;  ///< between places that are compared
  std::optional<PatchPlace> place_;
  std::set<std::string> paths_;  ///< that are taken
};

/// First members of groups that are more probable than not, two at most, and how much of each is most probable.
struct Leading {
  std::vector<std::size_t> candidates;
  std::vector<double> amplitudes;
};
Leading leading_in(const Weighed& weighed);

}  // namespace tether
