#pragma once

#include <compare>
#include <string>
#include <vector>

namespace tether {

/// Values of the model's numbers, by name.
struct NamedValues {
  std::vector<std::string> names;
  std::vector<double> values;
  auto operator<=>(const NamedValues&) const = default;
};

}  // namespace tether
