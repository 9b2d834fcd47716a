#include "diagnosis/search/diagnosis.hpp"

#include <optional>

#include "common/base/error.hpp"
#include "diagnosis/evidence/noise_factors.hpp"
#include "diagnosis/noise/noise_of_evidence.hpp"
#include "diagnosis/search/division.hpp"
#include "diagnosis/search/further_measurements.hpp"
#include "diagnosis/search/misfit_map.hpp"
#include "diagnosis/search/patch_search.hpp"
#include "diagnosis/search/published_models.hpp"
#include "diagnosis/search/trials.hpp"

namespace tether {
namespace {

SearchSettings search_settings(const DiagnosisCase& d, const DiagnosisSettings& settings) {
  return {d.alpha,       d.unexplained, settings.enough,           d.most,
          d.refinements, d.confirmed,   SearchSettings{}.compared, settings.refused};
}

void add_refined(EffectProblem& problem, const Evidence& evidence, const std::vector<RefinedRun>& refined) {
  for (const RefinedRun& one : refined)
    if (!one.motion.failed())
      add_numerics(problem, one.refined,
                   problem.residual - residuals_of(evidence, {one.motion}, problem.residual).col(0));
}

/// The same runs of a problem that has more amplitudes.
std::vector<ShownRun> as_many(std::vector<ShownRun> runs, Eigen::Index amplitudes) {
  for (ShownRun& run : runs) run.amplitudes.conservativeResizeLike(VectorXd::Zero(amplitudes));
  return runs;
}

/// Accepted effects with rivals that these data cannot tell from them; where none is accepted, what was tried and
/// nothing. runs: of the sensitivities; the pairs' are added.
std::vector<Rivals> rivals_in(const DiagnosisReport& report, const Trials& trials, std::vector<FinishedMotion>& runs) {
  std::vector<Rivals> pairs;
  const auto with = [&](const TestedEffect& effect) {
    runs.push_back(trials.motion_with(effect.run));
    return static_cast<Eigen::Index>(runs.size()) - 1;
  };
  const VectorXd nothing = VectorXd::Zero(report.problem.changes.cols());
  runs.push_back(trials.motion_with(nothing));
  const auto base = static_cast<Eigen::Index>(runs.size()) - 1;
  const bool is_accepted = std::any_of(report.found.effects.begin(), report.found.effects.end(),
                                       [](const TestedEffect& effect) { return effect.accepted; });
  for (const TestedEffect& tried : report.found.effects)
    if (!is_accepted && tried.confirmed)
      pairs.push_back({trials.residual_with(tried.run), report.problem.residual, with(tried), base, base});
  for (const TestedEffect& rival : report.found.effects)
    for (const TestedEffect& one : report.found.effects)
      if (one.accepted && rival.rival && !rival.accepted && one.group == rival.group)
        pairs.push_back({trials.residual_with(one.run), trials.residual_with(rival.run), with(one), with(rival), base});
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

/// Takes the noise of each source for as large as the data say.
std::vector<NoiseFactor> widen_noise(Whitening& whitening, const Evidence& evidence, const EffectProblem& white) {
  const NoiseFactors factors = noise_factors(white, whitening.bands());
  whitening.widen(larger_noise(whitening.bands(), factors));
  std::vector<NoiseFactor> all;
  for (const auto& [band, factor] : factors) {
    if (all.empty() || all.back().source != evidence.field_of_source(band.source))
      all.push_back({evidence.field_of_source(band.source)});
    (band.is_long ? all.back().long_waves : all.back().factor) = factor;
  }
  return all;
}

/// What the case states of the noise, held against what is left with all that was accepted. as_data: the problem before
/// it was whitened, which lacks what was divided off later.
std::vector<NoiseCheck> noise_left(const VectorXd& accepted, const Evidence& evidence, const EffectProblem& as_data,
                                   Trials& trials) {
  trials.residual_at(accepted);  // provides the run
  std::vector<Eigen::Index> moved;
  for (Eigen::Index i = 0; i < as_data.changes.cols(); ++i)
    if (accepted(i) != 0) moved.push_back(i);
  const VectorXd left = residuals_of(evidence, {trials.motion_with(accepted)}, as_data.residual).col(0);
  return noise_checks(evidence, as_data, left, as_data.changes(Eigen::all, moved));
}

MisfitMap misfit_map(const EffectProblem& problem, const DiagnosedCase& given, const Evidence& evidence,
                     const Whitening& whitening) {
  const TimeCase& time = given.file.common().time;
  return {evidence, whitening, problem, time.start, time.end};
}

/// Where the misfit is largest that what leads leaves, and that it leaves without the one that is missed least; none if
/// what leads leaves no more than chance makes. residual_at: of the model itself, since a coarser one is off by more
/// than the noise where what leads changes much; first_at: of the runs that explore, where only the place is asked.
std::vector<Ball> misfits_left(const EffectProblem& problem, const Weighed& weighed, const ResidualAt& residual_at,
                               const ResidualAt& first_at, const MisfitMap& map, double alpha) {
  const Leading leading = leading_in(weighed);
  const auto count = static_cast<Eigen::Index>(leading.candidates.size());
  VectorXd together = VectorXd::Zero(problem.changes.cols());
  MatrixXd without = MatrixXd::Zero(together.size(), count);  // each of them
  for (std::size_t k = 0; k < leading.candidates.size(); ++k) {
    const auto& own = problem.candidates[leading.candidates[k]].amplitudes;
    if (own.size() == 1)  // one that has several has no single one that is most probable
      together[own.front()] = leading.amplitudes[k];
  }
  const auto of_all = map.worst(residual_at(together).col(0));
  if (!of_all || of_all->p > alpha / 5) return {};
  for (Eigen::Index k = 0; k < count; ++k) {
    without.col(k) = together;
    for (const Eigen::Index i : problem.candidates[leading.candidates[static_cast<std::size_t>(k)]].amplitudes)
      without(i, k) = 0;
  }
  const MatrixXd left = first_at(without);
  std::optional<LocatedMisfit> least;
  for (const auto& one : left.colwise())
    if (const auto misfit = map.worst(one); misfit && (!least || misfit->z < least->z)) least = misfit;
  std::vector<Ball> starts{{of_all->centre, of_all->radius}};
  if (least) starts.push_back({least->centre, least->radius});
  return starts;
}

std::vector<PlacedEffect> effects_of(const std::vector<PatchEffect>& patches) {
  std::vector<PlacedEffect> all;
  for (const PatchEffect& patch : patches) all.push_back(patch.effect);
  return all;
}

/// Those that are to be varied.
std::vector<VariedNumber> numbers_of(const std::vector<PatchEffect>& patches, const std::vector<VariedNumber>& all) {
  std::vector<VariedNumber> wanted;
  for (const PatchEffect& patch : patches)
    for (const VariedNumber& one : all) {
      const std::string& name = one.number.name;
      if (!name.starts_with(patch.effect.path + ".")) continue;
      const std::string number = name.substr(patch.effect.path.size() + 1);
      if ((patch.number.empty() || number == patch.number) && number != patch.other_than) wanted.push_back(one);
    }
  return wanted;
}

/// Leaves none but those on the patch that explains most: how exactly its place is known, is told of it.
void settle(std::vector<Candidate>& candidates, const std::optional<PatchPlace>& place) {
  std::erase_if(candidates, [&](const Candidate& candidate) {
    return candidate.is_tried && !(place && candidate.extent.about == place->patch);
  });
}

/// Where on the wall data and model differ, of the model as it is and with what was accepted.
void locate_misfit(DiagnosisReport& report, const DiagnosedCase& given, const MisfitMap& map) {
  report.located = {map.worst(report.problem.residual), map.worst(report.found.residual)};
  for (auto* misfit : {&report.located.before, &report.located.after})
    if (misfit->has_value()) (*misfit)->unit = given.file.units().symbol(dimension::length);
  if (report.located.after)
    report.misfit_map = map.significance(given.lumen.points, report.located.after->radius, report.found.residual);
}

/// The model as it is. Throws RunError if it does not come to its end.
FinishedMotion base_of(ModelRuns& runs) {
  FinishedMotion base = runs.make({base_run()}).front();
  if (base.failed()) throw run_error("the model as it is: {}", base.failure);
  return base;
}

DiagnosisCost cost_of(const DiagnosedModel& model, const Sensitivities& sensitivities) {
  DiagnosisCost cost;
  std::vector<const ModelRuns*> all{&model.runs, model.coarse};
  for (const RefinedRun& refined : model.refined) all.push_back(refined.runs);
  for (const ModelRuns* runs : all) {
    if (runs == nullptr) continue;
    cost.runs += runs->cost().runs;
    cost.runs_made += runs->cost().made;
    cost.cpu_seconds += runs->cost().cpu_seconds;
  }
  cost.sensitivity_runs = static_cast<int>(sensitivities.motions.size());
  if (model.coarse != nullptr) cost.coarse_runs = model.coarse->cost().runs;
  return cost;
}

}  // namespace

DiagnosisReport diagnose(const DiagnosedCase& given, const std::vector<PlacedEffect>& effects,
                         const DiagnosedModel& model, const DiagnosisSettings& settings) {
  DiagnosisReport report;
  report.case_name = given.file.common().name;
  report.title = given.file.common().title;
  report.alpha = given.diagnosis.alpha;
  report.effects = effects;
  Division division(effects, varied_numbers(model.runs.parameters(), given.diagnosis, given.file));
  ModelRuns& first_order = model.coarse != nullptr ? *model.coarse : model.runs;
  Sensitivities sensitivities = sensitivities_of(first_order, division.undivided());
  sensitivities.is_coarse = model.coarse != nullptr;
  const FinishedMotion base = sensitivities.is_coarse ? base_of(model.runs) : sensitivities.motions.front();
  const Evidence evidence(given.data, given.lumen, base);
  EffectProblem problem = problem_of(given, evidence, base, sensitivities, effects);
  add_refined(problem, evidence, model.refined);
  const EffectProblem as_data = problem;
  Whitening whitening(evidence, problem);
  report.noise_factors = widen_noise(whitening, evidence, whitening(problem));
  report.problem = whitening(std::move(problem));
  Trials trials(report.problem, evidence, whitening, base, model.runs);
  Trials first_trials(report.problem, evidence, whitening, sensitivities.motions.front(), first_order);
  const SearchSettings how = search_settings(given.diagnosis, settings);
  const ResidualAt residual_at = [&](const MatrixXd& amplitudes) { return trials.residual_at(amplitudes); };
  const ResidualAt first_at = [&](const MatrixXd& amplitudes) { return first_trials.residual_at(amplitudes); };
  const ShowingRuns exploring{sensitivities.is_coarse ? first_at : residual_at,
                              sensitivities.is_coarse ? RunOf::coarser : RunOf::model};
  std::optional<Trials> finer_trials;
  for (const RefinedRun& refined : model.refined)
    if (refined.tells_effects && !refined.motion.failed())
      finer_trials.emplace(report.problem, evidence, whitening, refined.motion, *refined.runs);
  ResidualAt finer_at;
  if (finer_trials) finer_at = [&](const MatrixXd& amplitudes) { return finer_trials->residual_at(amplitudes); };
  Weighing weighing = weigh_effects(report.problem, how, exploring, RunsFor::exploring);
  const auto explore = [&](const std::vector<VariedNumber>& more) {
    std::vector<FinishedMotion> motions{sensitivities.motions.front()};
    for (FinishedMotion& motion : add_sensitivities(sensitivities, first_order, more))
      motions.push_back(std::move(motion));
    add_model_changes(report.problem,
                      {more, whitening(residuals_of(evidence, motions, as_data.residual)), sensitivities.is_coarse},
                      report.effects, given.diagnosis);
    weighing = weigh_effects(report.problem, how, exploring, RunsFor::exploring,
                             as_many(weighing.shown, report.problem.changes.cols()));
  };
  while (true) {
    const std::vector<VariedNumber> parts =
        division.next(report.problem, weighing.weighed, SetEvidence(report.problem, weighing.shown));
    if (parts.empty()) break;
    explore(parts);
  }
  const MisfitMap map = misfit_map(report.problem, given, evidence, whitening);
  PatchSearch patches(effects, given.lumen, given.file.units().symbol(dimension::length));
  const auto tell = [&] {
    weighing = weigh_effects(report.problem, how, {residual_at}, RunsFor::telling, std::move(weighing.shown), finer_at);
  };
  tell();
  std::vector<Ball> starts;
  if (model.extend)
    starts = misfits_left(report.problem, weighing.weighed, residual_at, first_at, map, given.diagnosis.alpha);
  while (!starts.empty()) {
    const std::vector<PatchEffect> wanted = patches.next(report.problem, weighing, starts);
    if (wanted.empty()) break;
    model.extend(effects_of(wanted));
    for (const PatchEffect& patch : wanted) report.effects.push_back(patch.effect);
    explore(numbers_of(wanted, varied_numbers(first_order.parameters(), given.diagnosis, given.file)));
  }
  if (!starts.empty()) {
    settle(report.problem.candidates, patches.place());
    report.patch = patches.place();
    tell();
  }
  report.found = search_effects(report.problem, how, residual_at, weighing, finer_at);
  locate_misfit(report, given, map);
  report.noise = noise_left(report.found.amplitudes, evidence, as_data, trials);
  report.splits = splits_of(given, report, evidence, trials, sensitivities.motions, model.runs.columns());
  report.published = published_models(given, evidence, report, trials, base, model.runs);
  report.cost = cost_of(model, sensitivities);
  return report;
}

}  // namespace tether
