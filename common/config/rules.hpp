#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/base/effect.hpp"

namespace tether {

/// "must not be negative", "must be at least 0.1 and below 0.5"; empty for a range that allows everything.
std::string rule_of(const Range& range);

/// The candidate with the fewest letters changed, added, dropped or swapped; empty if none resembles `word`.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// "a, b, c"
std::string listed(const std::vector<std::string>& words);

}  // namespace tether
