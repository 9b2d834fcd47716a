#include "diagnosis/results/published.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tether {

std::string name_of(const QuantityFound& quantity) {
  std::string name(word_of(quantity.quantity));
  std::replace(name.begin(), name.end(), '_', ' ');
  if (!quantity.where.empty()) name += " at " + quantity.where;
  return name + " [" + quantity.unit + "]";
}

std::string value_text(const QuantityFound& quantity) {
  if (!quantity.lower || !quantity.upper) return fmt::format("{:.4g}", quantity.value);
  return fmt::format("{:.4g} ({:.4g} .. {:.4g})", quantity.value, *quantity.lower, *quantity.upper);
}

}  // namespace tether
