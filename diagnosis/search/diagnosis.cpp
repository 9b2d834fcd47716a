#include "diagnosis/search/diagnosis.hpp"

#include "diagnosis/search/division.hpp"
#include "diagnosis/search/further_measurements.hpp"
#include "diagnosis/search/trials.hpp"

namespace tether {
namespace {

SearchSettings search_settings(const DiagnosisCase& d, const DiagnosisSettings& settings) {
  return {d.alpha,       d.unexplained, settings.enough,           d.most,
          d.refinements, d.confirmed,   SearchSettings{}.compared, settings.refused};
}

void add_refined(EffectProblem& problem, const Evidence& evidence, const std::vector<RefinedRun>& refined) {
  for (const auto& [of, motion] : refined)
    if (!motion.failed())
      add_numerics(problem, of, problem.residual - residuals_of(evidence, {motion}, problem.residual).col(0));
}

/// Candidates that act in a part of their place: what their runs show is added to the problem. residuals: of the runs,
/// whitened.
void add_parts(EffectProblem& problem, const std::vector<VariedNumber>& parts, const MatrixXd& residuals,
               const std::vector<PlacedEffect>& effects, const DiagnosisCase& diagnosis) {
  MatrixXd with_base(residuals.rows(), residuals.cols() + 1);
  with_base << problem.residual, residuals;
  add_model_changes(problem, parts, with_base, effects, diagnosis);
}

/// The same runs of a problem that has more amplitudes.
std::vector<ShownRun> as_many(std::vector<ShownRun> runs, Eigen::Index amplitudes) {
  for (ShownRun& run : runs) run.amplitudes.conservativeResizeLike(VectorXd::Zero(amplitudes));
  return runs;
}

/// Accepted effects with rivals that these data cannot tell from them. runs: of the sensitivities; the pairs' are
/// added.
std::vector<Rivals> rivals_in(const DiagnosisReport& report, const Trials& trials, std::vector<FinishedMotion>& runs) {
  std::vector<Rivals> pairs;
  const auto with = [&](const TestedEffect& effect) {
    runs.push_back(trials.motion_with(effect.run));
    return static_cast<Eigen::Index>(runs.size()) - 1;
  };
  for (const TestedEffect& rival : report.found.effects)
    for (const TestedEffect& one : report.found.effects)
      if (one.accepted && rival.rival && !rival.accepted && one.group == rival.group)
        pairs.push_back({trials.residual_with(one.run), trials.residual_with(rival.run), with(one), with(rival)});
  return pairs;
}

/// What would tell those apart that these data cannot.
std::vector<Split> splits_of(const DiagnosedCase& given, const DiagnosisReport& report, const Evidence& evidence,
                             const Trials& trials, std::vector<FinishedMotion> motions,
                             const std::vector<std::string>& columns) {
  const std::vector<Rivals> pairs = rivals_in(report, trials, motions);
  if (pairs.empty()) return {};
  for (FinishedMotion& run : motions)
    if (run.failed()) run = motions.front();  // it changes nothing, as in the search
  return splits(report.problem, pairs, further_measurements(given, evidence, motions, columns));
}

}  // namespace

DiagnosisReport diagnose(const DiagnosedCase& given, const std::vector<PlacedEffect>& effects, ModelRuns& runs,
                         const std::vector<RefinedRun>& refined, const DiagnosisSettings& settings) {
  DiagnosisReport report;
  report.case_name = given.file.common().name;
  report.title = given.file.common().title;
  report.alpha = given.diagnosis.alpha;
  Division division(effects, varied_numbers(runs.parameters(), given.diagnosis, given.file));
  Sensitivities sensitivities = sensitivities_of(runs, division.undivided());
  const Evidence evidence(given.data, given.lumen, sensitivities.motions.front());
  EffectProblem problem = problem_of(given, evidence, sensitivities, effects);
  add_refined(problem, evidence, refined);
  const Whitening whitening(evidence, problem);
  report.problem = whitening(std::move(problem));
  Trials trials(report.problem, evidence, whitening, sensitivities.motions.front(), runs);
  const SearchSettings how = search_settings(given.diagnosis, settings);
  const ResidualAt residual_at = [&](const MatrixXd& amplitudes) { return trials.residual_at(amplitudes); };
  Weighing weighing = weigh_effects(report.problem, how, residual_at);
  for (std::vector<VariedNumber> parts = division.next(report.problem, weighing.weighed); !parts.empty();
       parts = division.next(report.problem, weighing.weighed)) {
    const std::vector<FinishedMotion> motions = add_sensitivities(sensitivities, runs, parts);
    const MatrixXd residuals = whitening(residuals_of(evidence, motions, evidence.problem().residual));
    add_parts(report.problem, parts, residuals, effects, given.diagnosis);
    weighing = weigh_effects(report.problem, how, residual_at, as_many(weighing.shown, report.problem.changes.cols()));
  }
  report.found = search_effects(report.problem, how, residual_at, weighing.weighed);
  report.splits = splits_of(given, report, evidence, trials, sensitivities.motions, runs.columns());
  report.cost.sensitivity_runs = static_cast<int>(sensitivities.motions.size());
  report.cost.runs = runs.cost().runs;
  report.cost.runs_made = runs.cost().made;
  report.cost.cpu_seconds = runs.cost().cpu_seconds;
  return report;
}

}  // namespace tether
