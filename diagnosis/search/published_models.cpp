#include "diagnosis/search/published_models.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/comparison/beat_quantities.hpp"
#include "diagnosis/comparison/displacement.hpp"
#include "diagnosis/evidence/data_errors.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

/// NAME of all numbers PREFIX.NAME.*, in their order.
std::vector<std::string> names_below(const std::string& prefix, const std::vector<protocol::ParameterInfo>& numbers) {
  std::vector<std::string> names;
  for (const protocol::ParameterInfo& number : numbers) {
    if (!number.name.starts_with(prefix)) continue;
    std::string name = number.name.substr(prefix.size());
    name.resize(name.rfind('.'));
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

BeatFacts facts_of(const DiagnosedCase& given, const ModelRuns& runs) {
  BeatFacts facts{given.file.units(), runs.columns(), names_below("fluid.inlets.", runs.parameters()),
                  names_below("fluid.outlets.", runs.parameters())};
  facts.imaged = given.file.common().image.pressure;
  for (const protocol::ParameterInfo& number : runs.parameters())
    if (number.name == "fluid.density") facts.density = number.value;
  if (!given.data.lumen.empty()) facts.period = given.data.lumen.front()->settings().period;
  return facts;
}

/// Of all frames that show where the lumen is.
std::vector<double> measured_times(const Evidence& evidence) {
  std::vector<double> times;
  for (const Evidence::Part& part : evidence.parts())
    if (evidence.fallible(part).in_place) times.push_back(part.time);
  return times;
}

VectorXd values_of(const std::vector<QuantityFound>& quantities) {
  VectorXd values(static_cast<Index>(quantities.size()));
  for (Index i = 0; i < values.size(); ++i) values(i) = quantities[static_cast<std::size_t>(i)].value;
  return values;
}

/// One model's quantities and how each of its effects moves them.
class Published {
 public:
  Published(const DiagnosedCase& given, const Evidence& evidence, const DiagnosisReport& report, Trials& trials,
            BeatFacts facts, const FinishedMotion& base)
      : given_(given),
        report_(report),
        trials_(trials),
        facts_(std::move(facts)),
        base_run_(base),
        times_(measured_times(evidence)),
        base_(quantities_of(base)) {}

  std::vector<PublishedQuantities> all() {
    const std::vector<const TestedEffect*> accepted = accepted_in_order();
    if (accepted.empty() || base_.empty()) return {};
    std::vector<Variant> variants{{ModelRole::accepted, accepted, {}, accepted.back()->run}};
    for (const TestedEffect& rival : report_.found.effects)
      for (std::size_t k = 0; k < accepted.size(); ++k)
        if (rival.rival && !rival.accepted && rival.group == accepted[k]->group && changes_model(rival))
          variants.push_back(in_place_of(k, accepted, rival));
    make_runs_of(variants);
    std::vector<PublishedQuantities> models{{ModelRole::as_it_is, {}, base_}};
    for (const Variant& variant : variants) add(models, variant);
    return models;
  }

 private:
  /// A model that explains the data.
  struct Variant {
    ModelRole role;
    std::vector<const TestedEffect*> effects;  ///< each has all before it in its run
    std::vector<const TestedEffect*> beside;  ///< the one in whose place the last of these is, and those accepted after
    VectorXd run;                             ///< amplitudes of all
    bool is_made_of_several() const { return beside.size() > 1; }
  };

  /// With the others as they were found.
  Variant in_place_of(std::size_t k, const std::vector<const TestedEffect*>& accepted,
                      const TestedEffect& rival) const {
    const auto place = accepted.begin() + static_cast<std::ptrdiff_t>(k);
    Variant variant{ModelRole::rival, {accepted.begin(), place}, {place, accepted.end()}, rival.run};
    variant.effects.push_back(&rival);
    if (!variant.is_made_of_several()) return variant;
    const auto &own = candidate_of(rival).amplitudes, &others = candidate_of(**place).amplitudes;
    variant.run = accepted.back()->run;
    variant.run(others).setZero();
    variant.run(own) = rival.run(own);
    return variant;
  }

  void make_runs_of(const std::vector<Variant>& variants) {
    MatrixXd wanted(report_.problem.changes.cols(), 0);
    for (const Variant& variant : variants)
      if (variant.is_made_of_several()) append_columns(wanted, variant.run);
    if (wanted.cols() > 0) trials_.residual_at(wanted);
  }

  const Candidate& candidate_of(const TestedEffect& effect) const {
    return report_.problem.candidates[effect.candidate];
  }
  bool changes_model(const TestedEffect& effect) const { return candidate_of(effect).takes_runs(); }
  Index size_of(const TestedEffect& effect) const { return (effect.run.array() != 0).count(); }

  /// Each has all before it in its run.
  std::vector<const TestedEffect*> accepted_in_order() const {
    std::vector<const TestedEffect*> all;
    for (const TestedEffect& effect : report_.found.effects)
      if (effect.accepted && effect.confirmed && changes_model(effect)) all.push_back(&effect);
    std::stable_sort(all.begin(), all.end(), [&](const auto* a, const auto* b) { return size_of(*a) < size_of(*b); });
    return all;
  }

  void add(std::vector<PublishedQuantities>& models, const Variant& variant) const {
    const std::optional<VectorXd> found = quantities_with(variant.run);
    if (!found) return;
    PublishedQuantities model{variant.role, {}, base_};
    VectorXd below = VectorXd::Zero(found->size()), above = below;  // squares
    bool is_known = true;
    const auto add_effect = [&](const TestedEffect& effect, const VectorXd& change, bool by_itself) {
      model.effects.push_back(text_of(finding_of(report_.problem, effect)));
      const Ends ends = ends_of(effect, change, by_itself);
      below += ends.least.cwiseMin(ends.most).cwiseMin(0).cwiseAbs2();
      above += ends.least.cwiseMax(ends.most).cwiseMax(0).cwiseAbs2();
      is_known = is_known && !effect.at_limit;
    };
    VectorXd before = values_of(base_);
    for (const TestedEffect* effect : variant.effects) {
      const VectorXd with = quantities_with(effect->run).value_or(before);
      add_effect(*effect, with - before, variant.effects.size() == 1 && !variant.is_made_of_several());
      before = with;
    }
    for (std::size_t k = 1; k < variant.beside.size(); ++k) {  // as in the model with what was accepted
      const std::optional<VectorXd> with = quantities_with(variant.beside[k]->run),
                                    without = quantities_with(variant.beside[k - 1]->run);
      add_effect(*variant.beside[k], with && without ? VectorXd(*with - *without) : VectorXd::Zero(found->size()),
                 false);
    }
    for (Index i = 0; i < found->size(); ++i) {
      QuantityFound& quantity = model.quantities[static_cast<std::size_t>(i)];
      quantity.value = (*found)(i);
      if (!is_known) continue;
      quantity.lower = quantity.value - std::sqrt(below(i));
      quantity.upper = quantity.value + std::sqrt(above(i));
    }
    models.push_back(std::move(model));
  }

  std::optional<VectorXd> quantities_with(const VectorXd& run) const {
    if (run.size() == 0) return std::nullopt;
    const FinishedMotion* motion = trials_.find(run);
    if (motion == nullptr || motion->failed()) return std::nullopt;
    return values_of(quantities_of(*motion));
  }
  std::vector<QuantityFound> quantities_of(const FinishedMotion& run) const {
    std::vector<QuantityFound> all = beat_quantities(run, facts_);
    if (times_.empty()) return all;
    const double moved = displacement_between(run, base_run_, given_.lumen, times_);
    all.push_back({Quantity::displacement, "", facts_.units.to_mm(moved), {}, {}, "mm"});
    return all;
  }

  /// How far quantities are from those found at either end of an effect's interval.
  struct Ends {
    VectorXd least, most;
  };
  /// change: what the effect does, as found. Linear in the amplitude between runs: the run without the effect, that
  /// with it as found, and of an effect by itself all that were made. (D.22)
  Ends ends_of(const TestedEffect& effect, const VectorXd& change, bool by_itself) const {
    const AmplitudeRange range = range_of(report_.problem, effect, main_amplitude(report_.problem, effect));
    const auto& own = candidate_of(effect).amplitudes;
    if (!by_itself || own.size() != 1) return {(range.does_least - 1) * change, (range.does_most - 1) * change};
    const double size = effect.run(own.front());
    std::vector<std::pair<double, VectorXd>> shown{{0, VectorXd::Zero(change.size())}, {size, change}};
    for (const double other : trials_.sizes_of(effect.candidate)) {
      VectorXd alone = VectorXd::Zero(effect.run.size());
      alone(own.front()) = other;
      if (const auto with = quantities_with(alone); with && other != size)
        shown.emplace_back(other, *with - values_of(base_));
    }
    std::sort(shown.begin(), shown.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    const bool is_shown = range.upper * size <= shown.back().first;
    return {between(shown, range.lower * size) - change, is_shown
                                                             ? VectorXd(between(shown, range.upper * size) - change)
                                                             : VectorXd((range.does_most - 1) * change)};
  }

  /// Linear between neighbours.
  static VectorXd between(const std::vector<std::pair<double, VectorXd>>& shown, double size) {
    std::size_t to = 1;
    while (to + 1 < shown.size() && shown[to].first < size) ++to;
    const auto& [a, at_a] = shown[to - 1];
    const auto& [b, at_b] = shown[to];
    return at_a + (size - a) / (b - a) * (at_b - at_a);
  }

  const DiagnosedCase& given_;
  const DiagnosisReport& report_;
  Trials& trials_;
  BeatFacts facts_;
  const FinishedMotion& base_run_;
  std::vector<double> times_;  ///< of frames
  std::vector<QuantityFound> base_;
};

}  // namespace

std::vector<PublishedQuantities> published_models(const DiagnosedCase& given, const Evidence& evidence,
                                                  const DiagnosisReport& report, Trials& trials,
                                                  const FinishedMotion& base, const ModelRuns& runs) {
  return Published(given, evidence, report, trials, facts_of(given, runs), base).all();
}

}  // namespace tether
