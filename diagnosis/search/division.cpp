#include "diagnosis/search/division.hpp"

#include <algorithm>

namespace tether {
namespace {

constexpr double probable = 0.2;         ///< of a group
constexpr std::size_t most_hopeful = 2;  ///< groups, where the catalogue has nothing that explains the data
constexpr double not_least = 0.1;        ///< share of a group's member

/// What may change along the vessel is asked for in both halves from the start.
bool is_of_whole_wall(const PlacedEffect& effect) {
  return effect.part.empty();
}

std::string last_word(const std::string& name) {
  return name.substr(name.rfind('.') + 1);
}

}  // namespace

Division::Division(const std::vector<PlacedEffect>& effects, const std::vector<VariedNumber>& all) {
  for (const VariedNumber& number : all) {
    const std::string path = number.number.name.substr(0, number.number.name.rfind('.'));
    const auto effect =
        std::find_if(effects.begin(), effects.end(), [&](const PlacedEffect& e) { return e.path == path; });
    if (effect == effects.end() || effect->extent.is_all() || !effect->is_new || is_of_whole_wall(*effect))
      undivided_.push_back(number);
    else
      parts_.push_back({number, &*effect});
  }
}

bool Division::divides(const Part& part, const Candidate& candidate) const {
  const bool is_number = last_word(part.number.number.name) == candidate.number;
  return part.effect->type == candidate.type && part.effect->part == candidate.part && is_number;
}

std::vector<VariedNumber> Division::next(const EffectProblem& problem, const Weighed& weighed) {
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
      if (member.extent.is_all() && k == 0) want_parts_of(member, nullptr);
      if (member.extent.is_all()) continue;
      for (const std::size_t other : group.members)
        if (problem.candidates[other].part == member.part) want_parts_of(problem.candidates[other], &member.extent);
    }
  }
  return wanted;
}

}  // namespace tether
