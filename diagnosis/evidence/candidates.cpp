#include "diagnosis/evidence/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "common/base/error.hpp"
#include "common/catalogue/effects_list.hpp"
#include "common/config/overlay.hpp"
#include "common/config/rules.hpp"
#include "common/io/record_file.hpp"
#include "common/protocol/launch.hpp"
#include "common/protocol/programs.hpp"
#include "diagnosis/evidence/data_errors.hpp"
#include "observation_manager/measurements/faults/faults.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

bool holds(const std::vector<std::string>& list, const std::string& word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// A generic direction is a candidate only if it is asked for.
bool is_wanted(const PossibleEffect& effect, const DiagnosisCase& diagnosis) {
  if (holds(diagnosis.exclude, effect.type) || holds(diagnosis.exclude, effect.part)) return false;
  if (holds(diagnosis.also, effect.type)) return true;
  return diagnosis.candidates.empty() ? !effect.generic : holds(diagnosis.candidates, effect.type);
}

/// solid.effects.contact_spine_outlet_half
std::string path_of(const PossibleEffect& effect) {
  if (!effect.path.empty()) return effect.path;
  std::string path = "solid.effects." + effect.type + (effect.part.empty() ? "" : "_" + effect.part);
  if (!effect.extent.is_all()) path += "_" + in_words(effect.extent, {});
  std::replace(path.begin(), path.end(), ' ', '_');
  return path;
}

/// A number of the model as an amplitude that is zero as the model is. What can be absent, as a spring can, adds up:
/// its prior is the same whether the model has some of it or none.
Amplitude amplitude_of(const protocol::ParameterInfo& p) {
  const bool is_absent = p.value == p.absent;
  Amplitude amplitude{p.name, p.meaning, p.unit, is_absent && p.value == p.lower, {}, p.value, {}};
  amplitude.lower = p.lower;
  amplitude.upper = p.upper;
  const bool adds_up = p.absent == 0 && p.scale > 0;
  amplitude.doubles = p.transform.starts_with("log") && p.value > 0 && !adds_up;
  if (is_absent || adds_up)
    amplitude.scale = amplitude.doubles ? std::log2(1 + p.scale / p.value) : p.scale;
  else
    amplitude.scale = amplitude.doubles && p.transform == "log" ? p.prior_deviation / std::log(2.0) : p.prior_deviation;
  return amplitude;
}

/// How far an input may be off without that being news.
double allowed_deviation(const Amplitude& amplitude, const DiagnosisCase& diagnosis) {
  if (holds(diagnosis.assumed, amplitude.name)) return infinite;
  const double inputs = diagnosis.allowed.inputs;
  return amplitude.doubles ? std::log2(1 + inputs) : inputs * std::abs(amplitude.base);
}

/// "spine, outlet half"; "the wall within 0.8 cm of (-1.6, 1.5, 6)".
std::string place_in_words(const PlacedEffect& effect) {
  if (effect.extent.is_all()) return effect.part;
  const std::string words = in_words(effect.extent, effect.length);
  if (effect.part.empty()) return (effect.extent.about ? "the wall " : "") + words;
  return effect.part + ", " + words;
}

/// The candidate that a number belongs to, made if need be.
Candidate& candidate_of(EffectProblem& problem, const Amplitude& amplitude, bool is_absent,
                        const std::vector<PlacedEffect>& effects) {
  const std::string path = amplitude.name.substr(0, amplitude.name.rfind('.'));
  const auto effect = std::find_if(effects.begin(), effects.end(), [&](const PlacedEffect& e) {
    return e.path == path && (is_absent || !e.is_new);  // a law's other numbers are the model's own
  });
  Candidate wanted{amplitude.name, {}, amplitude.meaning, Candidate::Kind::input, {}};
  if (is_absent && effect != effects.end()) {
    wanted = {effect->type, place_in_words(*effect), effect->meaning, Candidate::Kind::effect, {}};
    wanted.variant_of = effect->variant_of;
  }
  if (effect != effects.end()) {
    wanted.type = effect->type, wanted.part = effect->part, wanted.extent = effect->extent;
    wanted.mostly_in = effect->mostly_in, wanted.one_of = effect->one_of;
    wanted.is_tried = effect->is_tried;
    wanted.number = amplitude.name.substr(path.size() + 1);
  }
  if (wanted.kind == Candidate::Kind::effect && amplitude.one_sided) {  // one at a time
    wanted.parameter = amplitude.name.substr(path.size() + 1);
    return problem.candidates.emplace_back(wanted);
  }
  for (Candidate& known : problem.candidates)
    if (known.name == wanted.name && known.where == wanted.where) return known;
  return problem.candidates.emplace_back(wanted);
}

void check_known(const CaseFile& file, const std::string& field, const std::vector<std::string>& words,
                 const std::vector<std::string>& known) {
  for (const std::string& word : words) {
    if (holds(known, word)) continue;
    const std::string near = nearest(word, known);
    throw input_error("{}: {} is unknown here; {}", file.where(field), word,
                      near.empty() ? "known are " + listed(known) : fmt::format("did you mean {}?", near));
  }
}

EffectsList listed_by(const std::string& program, const CaseFile& file) {
  const ChildEnd end = capture({{sibling(program).string(), "--list-effects", file.path().string()}, {}});
  if (end.exit_code == exit_input_wrong) throw InputError(end.errors);
  if (end.exit_code != exit_done)
    throw run_error("{} --list-effects {}{}{}", program, how_it_ended(end.exit_code), end.errors.empty() ? "" : ": ",
                    end.errors);
  return record_of<EffectsList>(end.output, program + " --list-effects");
}

/// Types of effects and parts of the wall. Numbers, which have a dot, are known when the model has announced them.
void check_names(const CaseFile& file, const EffectsList& catalogue, const DiagnosisCase& diagnosis) {
  std::set<std::string> types, parts;
  const auto note = [&](const auto& effect) {
    types.insert(effect.type);
    if (!effect.part.empty()) parts.insert(effect.part);
  };
  std::for_each(catalogue.possible.begin(), catalogue.possible.end(), note);
  std::for_each(catalogue.present.begin(), catalogue.present.end(), note);
  check_known(file, "diagnosis.candidates", diagnosis.candidates, {types.begin(), types.end()});
  std::set<std::string> on_request = types;
  for (const auto& fault : Faults())
    if (fault->declaration().on_request) on_request.insert(fault->declaration().of_all.name);
  check_known(file, "diagnosis.also", diagnosis.also, {on_request.begin(), on_request.end()});
  parts.merge(types);
  std::vector<std::string> words;
  for (const std::string& word : diagnosis.exclude)
    if (word.find('.') == std::string::npos) words.push_back(word);
  check_known(file, "diagnosis.exclude", words, {parts.begin(), parts.end()});
}

/// Sections of data that no run needs to know: they pull none, and are compared when it is over. Where velocities were
/// measured, a run must record its own.
std::vector<std::string> not_recorded(const CaseFile& from, const Observations& data) {
  if (data.points().cols() == 0)
    return from.has("observations") ? std::vector<std::string>{"observations"} : std::vector<std::string>{};
  std::vector<std::string> sections;
  for (const Measurement* source : data.all())
    if (source->velocity_points().cols() == 0) sections.push_back(source->facts().field());
  return sections;
}

}  // namespace

bool has_catalogue(const std::string& code, const CaseFile& file) {
  return protocol::is_own(file.given("coupling.programs." + code));
}

std::vector<PlacedEffect> catalogue_of(const CaseFile& file, const DiagnosisCase& diagnosis) {
  EffectsList list = has_catalogue("solid", file) ? listed_by("solid", file) : EffectsList{};
  if (has_catalogue("fluid", file))
    for (PossibleEffect& law : listed_by("fluid", file).possible) list.possible.push_back(std::move(law));
  check_names(file, list, diagnosis);
  const std::string length = file.units().symbol(dimension::length);
  std::vector<PlacedEffect> all;
  for (const PossibleEffect& e : list.possible)
    if (is_wanted(e, diagnosis))
      all.push_back({path_of(e), e.type, e.part, e.meaning, true, e.required, e.variant_of, e.extent, length});
  for (const PresentEffect& e : list.present)
    all.push_back(
        {e.path, e.type, e.part, "An effect that the model has, at zero", false, {}, e.variant_of, e.extent, length});
  return all;
}

void check_diagnosis(const fs::path& case_file) {
  CaseFile file(case_file);
  if (!file.has("diagnosis")) return;
  DiagnosisCase diagnosis;
  file.read("diagnosis", diagnosis);
  catalogue_of(file, diagnosis);
}

void write_candidates(const fs::path& file, const CaseFile& from, const Observations& data,
                      const std::vector<PlacedEffect>& effects) {
  const CommonCase& common = from.common();
  Overlay overlay{
      fs::absolute(from.path()), common.name + "_candidates", common.titled(", with all candidates absent"), {}};
  for (const PlacedEffect& effect : effects) {
    if (!effect.is_new) continue;
    overlay.values.push_back({effect.path + ".type", effect.type});
    if (!effect.part.empty()) overlay.values.push_back({effect.path + ".region", effect.part});
    add_extent(overlay, effect);
    for (const std::string& required : effect.required)  // the period of a load
      overlay.values.push_back({effect.path + "." + required, number_text(common.time.end - common.time.start)});
  }
  overlay.values.push_back({"output.write_every", "1000000"});
  overlay.values.push_back({"output.checkpoint_every", "1000000"});
  if (from.has("observer")) overlay.values.push_back({"observer", ""});
  for (std::string& section : not_recorded(from, data)) overlay.values.push_back({std::move(section), ""});
  write_overlay(file, overlay);
}

void add_extent(Overlay& overlay, const PlacedEffect& effect) {
  if (effect.extent.from > 0) overlay.values.push_back({effect.path + ".from", number_text(effect.extent.from)});
  if (effect.extent.to < 1) overlay.values.push_back({effect.path + ".to", number_text(effect.extent.to)});
  if (!effect.extent.toward.empty()) overlay.values.push_back({effect.path + ".toward", effect.extent.toward});
  if (const auto& ball = effect.extent.about) {
    const Vec3& at = ball->centre;
    overlay.values.push_back({effect.path + ".about.point",
                              fmt::format("[{}, {}, {}]", number_text(at[0]), number_text(at[1]), number_text(at[2]))});
    overlay.values.push_back({effect.path + ".about.within", number_text(ball->radius)});
  }
}

void add_model_changes(EffectProblem& problem, const ModelChanges& changes, const std::vector<PlacedEffect>& effects,
                       const DiagnosisCase& diagnosis) {
  constexpr double no_response = 1e-3;  // of a noise's deviation, over all data
  for (std::size_t i = 0; i < changes.varied.size(); ++i) {
    const auto& [number, value] = changes.varied[i];
    const auto run = static_cast<Eigen::Index>(i) + 1;
    const Amplitude amplitude = amplitude_of(number);
    const double step = amplitude.doubles ? std::log2(value / amplitude.base) : value - amplitude.base;
    const VectorXd seen = changes.residuals.col(0) - changes.residuals.col(run);
    const VectorXd change = seen.array().isFinite().select(seen, 0);  // (D.7)
    if (change.dot(problem.precision.cwiseProduct(change)) < no_response * no_response) continue;
    const bool is_absent = number.value == number.absent, is_assumed = holds(diagnosis.assumed, amplitude.name);
    if (!is_absent || is_assumed) {
      const auto before = problem.allowed.cols();
      allow(problem, change / step, allowed_deviation(amplitude, diagnosis), {amplitude.name, amplitude});
      if (problem.allowed.cols() > before) problem.allowed_runs.push_back({before, run, step});
    }
    if (is_assumed) continue;
    candidate_of(problem, amplitude, is_absent, effects).amplitudes.push_back(problem.changes.cols());
    append_columns(problem.changes, change / step);
    problem.amplitudes.push_back(amplitude);
    problem.amplitudes.back().step = step;
    problem.amplitudes.back().is_coarse = changes.is_coarse;
  }
}

}  // namespace tether
