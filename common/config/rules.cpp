#include "common/config/rules.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace tether {
namespace {

/// Edits (a letter changed, added, dropped, or two neighbours swapped) that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> edits(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) edits[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) edits[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = edits[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      edits[i][j] = std::min({edits[i - 1][j] + 1, edits[i][j - 1] + 1, changed});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        edits[i][j] = std::min(edits[i][j], edits[i - 2][j - 2] + 1);
    }
  return edits[a.size()][b.size()];
}

std::string lower_rule(const Range& range) {
  return fmt::format("{} {}", range.lower_open ? "above" : "at least", range.lower);
}

std::string upper_rule(const Range& range) {
  return fmt::format("{} {}", range.upper_open ? "below" : "at most", range.upper);
}

}  // namespace

std::string rule_of(const Range& range) {
  const bool below = std::isfinite(range.lower), above = std::isfinite(range.upper);
  if (below && above) return "must be " + lower_rule(range) + " and " + upper_rule(range);
  if (below && range.lower == 0.0) return range.lower_open ? "must be positive" : "must not be negative";
  if (below) return "must be " + lower_rule(range);
  return above ? "must be " + upper_rule(range) : "";
}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  constexpr std::size_t longest = 100;  // what is longer resembles no field
  if (word.size() > longest) return best;
  std::size_t fewest = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const auto& candidate : candidates) {
    if (std::max(word.size(), candidate.size()) - std::min(word.size(), candidate.size()) >= fewest) continue;
    const std::size_t edits = edit_distance(word, candidate);
    if (edits < std::min(fewest, std::max(word.size(), candidate.size()))) {
      fewest = edits;
      best = candidate;
    }
  }
  return best;
}

std::string listed(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace tether
