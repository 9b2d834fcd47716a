#include "diagnosis/search/division.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tether {
namespace {

constexpr double probable = 0.2;         ///< of a group
constexpr std::size_t most_hopeful = 2;  ///< groups, where the catalogue has nothing that explains the data
constexpr double not_least = 0.1;        ///< share of a group's member

/// What may change along the vessel is asked for in both halves from the start.
bool is_end_of_whole_wall(const PlacedEffect& effect) {
  return effect.part.empty() && (effect.extent.from <= 0 || effect.extent.to >= 1);
}

std::string last_word(const std::string& name) {
  return name.substr(name.rfind('.') + 1);
}

/// What does much the same as a candidate of a part would if both acted in all of their place. Beside a part that
/// explains the data the wholes of others are improbable, and in no group; their parts need not be.
std::vector<std::size_t> alike_as_wholes(const EffectProblem& problem, const SetEvidence& evidence,
                                         const Candidate& of_part) {
  std::vector<std::size_t> wholes;
  std::optional<std::size_t> own;
  for (std::size_t c = 0; c < problem.candidates.size(); ++c) {
    const Candidate& candidate = problem.candidates[c];
    if (!candidate.takes_runs() || candidate.part != of_part.part || !candidate.extent.is_all()) continue;
    wholes.push_back(c);
    if (candidate.type == of_part.type && candidate.number == of_part.number) own = c;
  }
  if (!own) return {};
  std::erase_if(wholes, [&](std::size_t c) { return std::pow(evidence.cosine(*own, c), 2) <= look_alike; });
  return wholes;
}

}  // namespace

Division::Division(const std::vector<PlacedEffect>& effects, const std::vector<VariedNumber>& all) {
  for (const VariedNumber& number : all) {
    const std::string path = number.number.name.substr(0, number.number.name.rfind('.'));
    const auto effect =
        std::find_if(effects.begin(), effects.end(), [&](const PlacedEffect& e) { return e.path == path; });
    if (effect == effects.end() || effect->extent.is_all() || !effect->is_new || is_end_of_whole_wall(*effect))
      undivided_.push_back(number);
    else
      parts_.push_back({number, &*effect});
  }
}

bool Division::divides(const Part& part, const Candidate& candidate) const {
  const bool is_number = last_word(part.number.number.name) == candidate.number;
  return part.effect->type == candidate.type && part.effect->part == candidate.part && is_number;
}

std::vector<VariedNumber> Division::next(const EffectProblem& problem, const Weighed& weighed,
                                         const SetEvidence& evidence) {
  std::vector<VariedNumber> wanted;
  const auto want = [&](const Part& part) {
    if (told_.insert(part.number.number.name).second) wanted.push_back(part.number);
  };
  const auto want_parts_of = [&](const Candidate& candidate, const Extent* only) {
    for (const Part& part : parts_)
      if (divides(part, candidate) && (only == nullptr || part.effect->extent == *only)) want(part);
  };
  const bool is_incomplete = weighed.outside + weighed.more > probable;
  for (std::size_t g = 0; g < weighed.groups.size(); ++g) {
    const WeighedGroup& group = weighed.groups[g];
    if (group.probability < probable && !(is_incomplete && g < most_hopeful)) continue;
    for (std::size_t k = 0; k < group.members.size(); ++k) {
      const Candidate& member = problem.candidates[group.members[k]];
      if (group.shares[k] < not_least) continue;
      if (k == 0 && (member.extent.is_all() || member.part.empty())) want_parts_of(member, nullptr);
      if (member.extent.is_all()) continue;
      for (const std::size_t other : alike_as_wholes(problem, evidence, member))
        want_parts_of(problem.candidates[other], &member.extent);
    }
  }
  return wanted;
}

}  // namespace tether
