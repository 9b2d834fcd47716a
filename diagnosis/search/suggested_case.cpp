#include "diagnosis/search/suggested_case.hpp"

#include <algorithm>
#include <cmath>

#include "common/config/overlay.hpp"
#include "diagnosis/search/corrected_data.hpp"

namespace tether {
namespace {

/// What the case must say for an effect that it does not have.
void add_effect(Overlay& overlay, const PlacedEffect& effect, const TimeCase& time) {
  overlay.values.push_back({effect.path + ".type", effect.type});
  if (!effect.part.empty()) overlay.values.push_back({effect.path + ".region", effect.part});
  add_extent(overlay, effect);
  for (const std::string& required : effect.required)
    overlay.values.push_back({effect.path + "." + required, number_text(time.end - time.start)});
}

std::string without_dots(std::string name) {
  for (const char* prefix : {"solid.effects.", "solid.support.regions.", "solid.", "fluid."})
    if (name.starts_with(prefix)) {
      name = name.substr(std::string(prefix).size());
      break;
    }
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

/// The prior: what was found, and twice how unsure that is, at least a factor of the square root of two either way. The
/// same data found it: nearer to it they would count twice.
void add_parameter(Overlay& overlay, const Amplitude& amplitude, const FoundValue& found) {
  const std::string path = "identification.parameters." + without_dots(amplitude.name);
  const bool positive = amplitude.doubles || amplitude.one_sided || (amplitude.lower == 0 && amplitude.base > 0);
  overlay.values.push_back({path + ".of", "[" + amplitude.name + "]"});
  overlay.values.push_back({path + ".transform", positive ? "log2" : "linear"});
  overlay.values.push_back({path + ".mean", number_text(found.value)});
  const double half = found.upper - found.value;
  constexpr double unknown = 3;  // powers of two: more is no more of a prior
  const double deviation = positive ? std::clamp(2 * std::log2(found.upper / found.value), 0.5, unknown)
                                    : std::max(2 * half, 0.25 * std::abs(found.value));
  overlay.values.push_back({path + ".deviation", number_text(deviation)});
}

/// What the diagnosis allows data to be off by at all times, the filter allows as well.
void allow_the_same(Overlay& overlay, const LastingAllowance& allowed) {
  for (const auto& [name, deviation] :
       {std::pair{"model", allowed.model}, {"bias", allowed.bias}, {"displacement", allowed.displacement}})
    if (deviation) overlay.values.push_back({std::string("identification.allowed.") + name, number_text(*deviation)});
}

}  // namespace

bool write_corrected(const std::filesystem::path& file, const DiagnosedCase& given, const DiagnosisReport& report) {
  const std::vector<Overlay::Value> corrections = corrections_of(report, given.observations);
  if (corrections.empty()) return false;
  const CommonCase& common = given.file.common();
  write_overlay(file, {std::filesystem::absolute(given.file.path()), common.name + "_corrected",
                       common.titled(", with corrected data"), corrections});
  return true;
}

bool write_suggested(const std::filesystem::path& file, const DiagnosedCase& given, const DiagnosisReport& report) {
  const std::vector<PlacedEffect>& effects = report.effects;
  const CaseFile& from = given.file;
  Overlay overlay{std::filesystem::absolute(from.path()), from.common().name + "_suggested",
                  from.common().titled(", with what the diagnosis adds"), corrections_of(report, given.observations)};
  std::vector<std::string> added;
  bool nothing_added = true;
  for (const TestedEffect& effect : report.found.effects) {
    const Candidate& candidate = report.problem.candidates[effect.candidate];
    if (!effect.accepted || !candidate.takes_runs()) continue;
    for (Eigen::Index own = 0; own < effect.amplitudes.size(); ++own) {
      const auto number = static_cast<std::size_t>(candidate.amplitudes[static_cast<std::size_t>(own)]);
      const Amplitude& amplitude = report.problem.amplitudes[number];
      if (effect.amplitudes(own) == 0) continue;
      nothing_added = false;
      const auto placed = std::find_if(effects.begin(), effects.end(), [&](const PlacedEffect& e) {
        return e.is_new && candidate.kind == Candidate::Kind::effect && amplitude.name.starts_with(e.path + ".");
      });
      if (placed != effects.end() && std::find(added.begin(), added.end(), placed->path) == added.end()) {
        add_effect(overlay, *placed, from.common().time);
        added.push_back(placed->path);
      }
      const FoundValue found = value_of(report.problem, effect, own);
      overlay.values.push_back({amplitude.name, number_text(found.value)});
      add_parameter(overlay, amplitude, found);
    }
  }
  if (nothing_added) return false;
  if (!from.has("identification")) {
    overlay.values.push_back({"identification.observe", "frames"});
    allow_the_same(overlay, given.diagnosis.allowed);
  }
  write_overlay(file, overlay);
  return true;
}

}  // namespace tether
