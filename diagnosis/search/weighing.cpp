#include "diagnosis/search/weighing.hpp"

#include <algorithm>

#include "diagnosis/search/detectable.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

constexpr int rounds = 5;  ///< of runs, before what they tell is taken as it is

void add_shown(std::vector<ShownRun>& shown, const MatrixXd& wanted, const ShowingRuns& runs) {
  const MatrixXd residuals = runs.residual_at(wanted);
  for (Index k = 0; k < wanted.cols(); ++k) shown.push_back({wanted.col(k), residuals.col(k), runs.of});
}

}  // namespace

std::vector<bool> refused_in(const EffectProblem& problem, const SearchSettings& settings) {
  std::vector<bool> refused;
  for (const Candidate& candidate : problem.candidates)
    refused.push_back(std::any_of(candidate.amplitudes.begin(), candidate.amplitudes.end(), [&](Index i) {
      const std::string& name = problem.amplitudes[static_cast<std::size_t>(i)].name;
      return std::find(settings.refused.begin(), settings.refused.end(), name) != settings.refused.end();
    }));
  return refused;
}

Weighing weigh_effects(const EffectProblem& problem, const SearchSettings& settings, const ShowingRuns& runs,
                       RunsFor purpose, std::vector<ShownRun> shown, const ResidualAt& finer) {
  const std::vector<bool> left_out = refused_in(problem, settings);
  for (int round = 0; true;) {
    const SetEvidence evidence(problem, shown);
    const Posterior posterior = posterior_of(problem, evidence, left_out);
    const MatrixXd wanted = wanted_runs(problem, evidence, posterior, purpose);
    const bool is_settled = wanted.cols() == 0 || round >= rounds;
    const MatrixXd refined = is_settled && finer ? wanted_refined(problem, evidence, posterior, shown) : MatrixXd();
    if (refined.cols() > 0) {
      add_shown(shown, refined, {finer, RunOf::finer});
    } else if (!is_settled) {
      add_shown(shown, wanted, runs);
      ++round;
    } else {
      Weighing weighing{weighed(problem, evidence, posterior), std::move(shown)};
      if (purpose == RunsFor::telling) {
        weigh_otherwise(weighing.weighed, problem, weighing.shown, posterior);
        foretell_moments(weighing.weighed, problem, weighing.shown, posterior);
        weighing.weighed.detectable = detectable_sizes(problem, weighing.shown, posterior, settings.alpha);
      }
      return weighing;
    }
  }
}

Weighing weighed_fully(const EffectProblem& problem, const SearchSettings& settings, const ResidualAt& residual_at) {
  Weighing explored = weigh_effects(problem, settings, {residual_at}, RunsFor::exploring);
  return weigh_effects(problem, settings, {residual_at}, RunsFor::telling, std::move(explored.shown));
}

}  // namespace tether
