#include "diagnosis/search/diagnosis.hpp"

#include <optional>

#include "common/base/error.hpp"
#include "diagnosis/evidence/noise_factors.hpp"
#include "diagnosis/noise/noise_of_evidence.hpp"
#include "diagnosis/search/division.hpp"
#include "diagnosis/search/further_measurements.hpp"
#include "diagnosis/search/judgement.hpp"
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

/// A diagnosis while it is made. What each member is made from stands before it.
class DiagnosisRun {
 public:
  DiagnosisRun(const DiagnosedCase& given, const std::vector<PlacedEffect>& effects, const DiagnosedModel& model,
               const DiagnosisSettings& settings)
      : given_(given),
        model_(model),
        how_(search_settings(given.diagnosis, settings)),
        effects_(effects),
        first_order_(model.coarse != nullptr ? *model.coarse : model.runs),
        division_(effects, varied_numbers(model.runs.parameters(), effects, given.diagnosis, given.file)),
        sensitivities_(sensitivities_of(first_order_, division_.undivided())),
        base_(model.coarse != nullptr ? base_of(model.runs) : sensitivities_.motions.front()),
        evidence_(given.data, given.lumen, base_),
        as_data_(problem_of_data()),
        whitening_(evidence_, as_data_),
        report_(begun_report()),
        trials_(report_.problem, evidence_, whitening_, base_, model.runs),
        first_trials_(report_.problem, evidence_, whitening_, sensitivities_.motions.front(), first_order_) {
    for (const RefinedRun& refined : model.refined)
      if (refined.tells_effects && !refined.motion.failed())
        finer_trials_.emplace(report_.problem, evidence_, whitening_, refined.motion, *refined.runs);
    if (finer_trials_)
      finer_at_ = [this](const MatrixXd& amplitudes) { return finer_trials_->residual_at(amplitudes); };
  }

  DiagnosisReport run() {
    weigh_at_any_size();
    divide_places();
    const MisfitMap map = misfit_map(report_.problem, given_, evidence_, whitening_);
    weigh_what_is_probable();
    search_patches(map);
    report_.found = search_effects(report_.problem, how_, residual_at_, weighing_, finer_at_);
    conclude(map);
    return std::move(report_);
  }

 private:
  /// What data and model are, before they are whitened.
  EffectProblem problem_of_data() {
    sensitivities_.is_coarse = model_.coarse != nullptr;
    EffectProblem problem = problem_of(given_, evidence_, base_, sensitivities_, effects_);
    add_refined(problem, evidence_, model_.refined);
    return problem;
  }

  DiagnosisReport begun_report() {
    DiagnosisReport report;
    report.case_name = given_.file.common().name;
    report.title = given_.file.common().title;
    report.alpha = given_.diagnosis.alpha;
    report.effects = effects_;
    report.faults_not_asked = faults_not_asked(evidence_, given_.diagnosis.also);
    report.noise_factors = widen_noise(whitening_, evidence_, whitening_(as_data_));
    report.problem = whitening_(as_data_);
    return report;
  }

  void weigh_at_any_size(std::vector<ShownRun> shown = {}) {
    const ShowingRuns exploring{sensitivities_.is_coarse ? first_at_ : residual_at_,
                                sensitivities_.is_coarse ? RunOf::coarser : RunOf::model};
    weighing_ = weigh_effects(report_.problem, how_, exploring, RunsFor::exploring, std::move(shown));
  }
  void weigh_what_is_probable() {
    weighing_ =
        weigh_effects(report_.problem, how_, {residual_at_}, RunsFor::telling, std::move(weighing_.shown), finer_at_);
  }

  /// Asks for more numbers, and weighs anew.
  void explore(const std::vector<VariedNumber>& more) {
    std::vector<FinishedMotion> motions{sensitivities_.motions.front()};
    for (FinishedMotion& motion : add_sensitivities(sensitivities_, first_order_, more))
      motions.push_back(std::move(motion));
    add_model_changes(report_.problem,
                      {more, whitening_(residuals_of(evidence_, motions, as_data_.residual)), sensitivities_.is_coarse},
                      report_.effects, given_.diagnosis);
    weigh_at_any_size(as_many(weighing_.shown, report_.problem.changes.cols()));
  }

  void divide_places() {
    while (true) {
      const std::vector<VariedNumber> parts =
          division_.next(report_.problem, weighing_.weighed, SetEvidence(report_.problem, weighing_.shown));
      if (parts.empty()) return;
      explore(parts);
    }
  }

  /// Where what leads leaves something, places of the wall that no region is are asked too.
  void search_patches(const MisfitMap& map) {
    if (!model_.extend) return;
    const std::vector<Ball> starts =
        misfits_left(report_.problem, weighing_.weighed, residual_at_, first_at_, map, given_.diagnosis.alpha);
    if (starts.empty()) return;
    PatchSearch patches(effects_, given_.lumen, given_.file.units().symbol(dimension::length));
    while (true) {
      const std::vector<PatchEffect> wanted = patches.next(report_.problem, weighing_, starts);
      if (wanted.empty()) break;
      model_.extend(effects_of(wanted));
      for (const PatchEffect& patch : wanted) report_.effects.push_back(patch.effect);
      explore(numbers_of(wanted,
                         varied_numbers(first_order_.parameters(), report_.effects, given_.diagnosis, given_.file)));
    }
    settle(report_.problem.candidates, patches.place());
    report_.patch = patches.place();
    weigh_what_is_probable();
  }

  /// What is told beside what was found.
  void conclude(const MisfitMap& map) {
    locate_misfit(report_, given_, map);
    judge_place(report_.located.after, report_.problem, report_.found);
    report_.noise = noise_left(report_.found.amplitudes, evidence_, as_data_, trials_);
    report_.splits = splits_of(given_, report_, evidence_, trials_, sensitivities_.motions, model_.runs.columns());
    report_.published = published_models(given_, evidence_, report_, trials_, base_, model_.runs);
    report_.cost = cost_of(model_, sensitivities_);
  }

  const DiagnosedCase& given_;
  const DiagnosedModel& model_;
  const SearchSettings how_;
  const std::vector<PlacedEffect>& effects_;
  ModelRuns& first_order_;  ///< for what numbers do to first order
  Division division_;
  Sensitivities sensitivities_;
  const FinishedMotion base_;
  const Evidence evidence_;
  const EffectProblem as_data_;
  Whitening whitening_;
  DiagnosisReport report_;
  Trials trials_, first_trials_;
  std::optional<Trials> finer_trials_;
  Weighing weighing_;
  const ResidualAt residual_at_ = [this](const MatrixXd& amplitudes) { return trials_.residual_at(amplitudes); };
  const ResidualAt first_at_ = [this](const MatrixXd& amplitudes) { return first_trials_.residual_at(amplitudes); };
  ResidualAt finer_at_;  ///< of a finer model, if there is one
};

}  // namespace

DiagnosisReport diagnose(const DiagnosedCase& given, const std::vector<PlacedEffect>& effects,
                         const DiagnosedModel& model, const DiagnosisSettings& settings) {
  return DiagnosisRun(given, effects, model, settings).run();
}

}  // namespace tether
