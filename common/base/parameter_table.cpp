#include "common/base/parameter_table.hpp"

#include <cmath>

#include "common/base/error.hpp"

namespace tether {

const ParameterTable::Entry& ParameterTable::checked(const std::string& name, double value) const {
  std::string known;
  for (const Entry& entry : entries_) {
    known += (known.empty() ? "" : ", ") + entry.name;
    if (entry.name != name) continue;
    if (!std::isfinite(value) || !entry.declaration.range.contains(value))
      throw input_error("parameter {}: {} is out of its range", name, value);
    return entry;
  }
  throw input_error("there is no parameter {}; known are: {}", name, known);
}

void ParameterTable::set(const std::string& name, double value) const {
  checked(name, value).set(value);
}

void ParameterTable::set(const std::vector<std::string>& names, const std::vector<double>& values) const {
  if (names.size() != values.size())
    throw input_error("{} names of parameters, but {} values", names.size(), values.size());
  for (std::size_t i = 0; i < names.size(); ++i) checked(names[i], values[i]);
  for (std::size_t i = 0; i < names.size(); ++i) set(names[i], values[i]);
}

std::vector<double> ParameterTable::values() const {
  std::vector<double> result;
  for (const Entry& entry : entries_) result.push_back(entry.value());
  return result;
}

std::string name_of(Transform transform) {
  switch (transform) {
    case Transform::linear:
      return "linear";
    case Transform::log:
      return "log";
    case Transform::log2:
      return "log2";
    case Transform::bounded:
      return "bounded";
  }
  return "linear";
}

}  // namespace tether
