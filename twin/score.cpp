#include "twin/score.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/io/record_file.hpp"

namespace tether {
namespace {

std::string place_of(const std::string& name, const std::string& where) {
  return where.empty() ? name : name + " at " + where;
}
std::string place_of(const ClaimedEffect& effect) {
  return place_of(effect.name, effect.where.value_or(""));
}

/// There, or in a part of that place.
bool is_at(const ClaimedEffect& found, const std::string& where) {
  const std::string place = found.where.value_or("");
  return where.empty() || place == where || place.starts_with(where + ", ");
}

bool is(const ClaimedEffect& found, const Answer::Effect& hidden) {
  return found.name == hidden.name && is_at(found, hidden.where);
}

bool is_accepted(const ClaimedEffect& effect) {
  return effect.accepted.value_or(false);
}

/// The group of an effect, if any of it was accepted.
bool in_accepted_group(const Claim& claim, const ClaimedEffect& effect) {
  return effect.group && std::any_of(claim.effects.begin(), claim.effects.end(),
                                     [&](const ClaimedEffect& e) { return is_accepted(e) && e.group == effect.group; });
}

void compare_amplitudes(FoundEffect& result, const ClaimedAmplitude& amplitude) {
  const Answer::Effect& hidden = result.hidden;
  if (amplitude.unit.value_or("") != hidden.unit || !amplitude.value) return;
  result.amplitude_error = *amplitude.value / hidden.amplitude - 1;
  if (amplitude.lower && amplitude.upper)
    result.within_interval = *amplitude.lower <= hidden.amplitude && hidden.amplitude <= *amplitude.upper;
}

FoundEffect found(const Claim& claim, const Answer::Effect& hidden) {
  FoundEffect result{hidden, {}, false, false, {}, {}};
  const auto effect =
      std::find_if(claim.effects.begin(), claim.effects.end(), [&](const ClaimedEffect& e) { return is(e, hidden); });
  if (effect == claim.effects.end()) return result;
  result.rank = static_cast<int>(effect - claim.effects.begin()) + 1;
  result.accepted = is_accepted(*effect);
  result.in_accepted_group = in_accepted_group(claim, *effect);
  if (effect->amplitude) compare_amplitudes(result, *effect->amplitude);
  return result;
}

bool is_right(const Score& score) {
  if (score.verdict != score.true_verdict) return false;
  const auto all = [&](auto holds) { return std::all_of(score.found.begin(), score.found.end(), holds); };
  if (score.verdict == Verdict::missing)
    return score.wrongly_accepted.empty() && all([](const FoundEffect& e) { return e.accepted; });
  if (score.verdict == Verdict::ambiguous)
    return all([](const FoundEffect& e) { return e.accepted || e.in_accepted_group; });
  return true;
}

std::string judgement_of(const Score& score) {
  if (score.verdict != score.true_verdict) return fmt::format("wrong, the answer is {}", word_of(score.true_verdict));
  if (score.verdict_right) return "right";
  return score.verdict == Verdict::missing ? "right; what was accepted is not what was hidden"
                                           : "right; what was hidden is not in a group of what was accepted";
}

std::string line_of(const FoundEffect& found) {
  std::string line = place_of(found.hidden.name, found.hidden.where) + ": ";
  if (!found.rank) return line + "not among the effects of the diagnosis\n";
  line += fmt::format("rank {}, {}", *found.rank, found.accepted ? "accepted" : "not accepted");
  if (found.in_accepted_group && !found.accepted) line += ", its group is";
  if (found.amplitude_error) line += fmt::format(", amplitude {:+.1f} %", 100 * *found.amplitude_error);
  if (found.within_interval) line += *found.within_interval ? ", within its interval" : ", outside its interval";
  return line + "\n";
}

}  // namespace

Claim read_claim(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) throw input_error("{}: no such file; run tether diagnose first", file.string());
  try {
    return read_record<Claim>(file);
  } catch (const InputError& error) {
    throw input_error("is no diagnosis: {}", error.what());
  }
}

Score score_of(const Claim& claim, const Answer& answer) {
  Score score;
  score.verdict = claim.verdict;
  score.true_verdict = answer.verdict;
  for (const auto& hidden : answer.effects) score.found.push_back(found(claim, hidden));
  for (const ClaimedEffect& effect : claim.effects)
    if (is_accepted(effect) &&
        std::none_of(answer.effects.begin(), answer.effects.end(), [&](const auto& h) { return is(effect, h); }))
      score.wrongly_accepted.push_back(place_of(effect));
  if (claim.held_out) score.held_out_gain = 1 - claim.held_out->after / claim.held_out->before;
  score.verdict_right = is_right(score);
  return score;
}

std::string text_of(const Score& score) {
  std::string text = fmt::format("verdict: {}: {}\n", word_of(score.verdict), judgement_of(score));
  for (const FoundEffect& found : score.found) text += line_of(found);
  for (const std::string& effect : score.wrongly_accepted) text += effect + ": accepted, but was not hidden\n";
  if (score.held_out_gain) text += fmt::format("held-out distance: {:.1f} % less\n", 100 * *score.held_out_gain);
  return text;
}

}  // namespace tether
