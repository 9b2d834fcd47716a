#pragma once

#include <algorithm>
#include <array>
#include <string_view>

/// How sentences begin that tell what is saved of a run that ends before its time, and how to go on: for those who
/// write them, and for who looks in a log for what happened.
namespace tether {

inline constexpr std::string_view to_continue = "To continue: ", state_after = "The state after ",
                                  no_state_saved = "No state is saved";

inline bool is_about_going_on(std::string_view line) {
  constexpr std::array beginnings{to_continue, state_after, no_state_saved};
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](std::string_view text) { return line.starts_with(text); });
}

}  // namespace tether
