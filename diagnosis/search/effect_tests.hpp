#pragma once

#include <algorithm>
#include <optional>

#include "diagnosis/search/held_out_gain.hpp"
#include "diagnosis/search/trained.hpp"

namespace tether {

/// What the data say of one candidate.
struct TestedEffect {
  std::size_t candidate = 0;
  double gain = 0;                  ///< of the misfit, by its best amplitudes to first order (D.10)
  double z = 0, p = 1, q = 1;       ///< q: corrected for the number of candidates
  VectorXd amplitudes, deviations;  ///< of its own; after confirmation at finite size
  /// Of each of its own, beside all that may be there too; those of several by what they do to first order.
  std::vector<std::optional<AmplitudeInterval>> intervals;
  double saturation = 0;      ///< c f of f/(1 + c f), which it follows by runs (D.10); 0: in proportion
  double retained = 0;        ///< share of its information that errors allowed cannot explain as well
  bool confirmed = false;     ///< the amplitudes are those of runs
  double confirmed_gain = 0;  ///< of the misfit, by those runs
  bool at_limit = false;      ///< one of its amplitudes would have to be larger than it may be
  VectorXd run;               ///< amplitudes of all candidates in the best of those runs [q]
  std::optional<Gain> held_out;
  bool accepted = false;
  bool beside = false;   ///< others were accepted too: its deviation is that of runs of all of them together
  bool rival = false;    ///< by runs, these data cannot tell it from an accepted one
  int group = -1;        ///< effects that look alike have the same number
  double cosine = 0;     ///< with the first of the group
  bool testable = true;  ///< the data would show it at a size that it may have
  double visible = 0;  ///< smallest size of its first amplitude that the data would show, in 80 of 100 such sets; below
                       ///< zero where only smaller values are admissible (D.12)
};

/// That of a candidate, which must be among them.
auto& of_candidate(auto& effects, std::size_t candidate) {
  return *std::find_if(effects.begin(), effects.end(),
                       [&](const TestedEffect& effect) { return effect.candidate == candidate; });
}

/// Smallest and largest of an amplitude, as factors of what was found.
struct AmplitudeRange {
  double lower = 1, upper = 1;
  double does_least = 1, does_most = 1;  ///< what the effect does with it, over what it does as found
};

/// 95 %, of one of the effect's own amplitudes: as its interval, where there is one; of one of several, what it does
/// lies about what was found as the interval does about its middle. That is of what each of several does by itself:
/// beside others that were accepted, or where runs found the amplitude outside of it, it holds what these show too.
/// Else what runs showed is known in the logarithm of what the amplitude does: of one that saturates much larger ones
/// do hardly more. It ends at a hundred times what was found. (D.10)
AmplitudeRange range_of(const EffectProblem& problem, const TestedEffect& effect, Eigen::Index own);

/// Every candidate against a residual of which `scores` tell, to first order; count: of independent data. (D.8-D.10)
std::vector<TestedEffect> test_all(const EffectProblem& problem, const Scores& scores, double count);

/// Probability that noise makes a candidate's gain as large. (D.10)
double chance_of(const EffectProblem& problem, std::size_t candidate, double gain);

/// Amplitudes in proportion to the effect's own, the largest of them as in a patient; of an effect without any its
/// first.
VectorXd as_in_patients(const EffectProblem& problem, const TestedEffect& effect);

/// Of the model's changes for two effects, each at its best amplitudes. (D.9)
double cosine(const EffectProblem& problem, const Scores& scores, const TestedEffect& a, const TestedEffect& b);

/// The same of the first `count`, each with each other.
MatrixXd cosines_of_first(const std::vector<TestedEffect>& effects, int count, const EffectProblem& problem,
                          const Scores& scores);

/// Evidence less what so many amplitudes cost with `count` independent data (BIC), and what their sizes cost if they
/// may be of any order of magnitude beyond the scale that they may have in a patient. (D.10)
double worth(const EffectProblem& problem, const TestedEffect& effect, double count);

/// How much of the misfit no noise, no allowed error and no accepted effect explains. (D.11)
struct LackOfFit {
  double p = 1;             ///< that noise alone makes the worst pattern
  double pooled = 1;        ///< that noise alone makes all of them together
  double excess = 0;        ///< of the patterns' squares over what noise makes
  double beyond_noise = 0;  ///< of them, or of the worst alone, over what noise makes in one of twenty cases
  std::size_t worst = 0;
  double z = 0;  ///< of the worst
};
LackOfFit lack_of_fit(const EffectProblem& problem, const Trained& trained, const VectorXd& residual);

/// Numbers those that look alike, in what they do at their best amplitudes: the square of the cosine of two exceeds a
/// half, and the one leaves less than 12 of the other's gain (D.9); and rivals. The accepted ones come first, then by
/// evidence; `rival_of`: of each candidate the accepted one that it rivals, or itself.
void set_groups(std::vector<TestedEffect>& effects, const EffectProblem& problem, const Scores& scores, double count,
                const std::vector<std::size_t>& rival_of);

}  // namespace tether
