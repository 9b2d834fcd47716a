#include "observation_manager/measurements/measured_run.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"

namespace tether {

double ModelMoment::value(const std::string& column) const {
  const auto found = std::find(names.begin(), names.end(), column);
  if (found == names.end())
    throw input_error("the model has no observable {}; it has: {}", column, fmt::join(names, ", "));
  return values[static_cast<std::size_t>(found - names.begin())];
}

Points ModelMoment::velocity_at(const Points& some) const {
  return velocities.middleCols(place_of(some, points), some.cols());
}

std::optional<double> time_in_run(double time, double period, double start, double end, double tolerance) {
  if (std::isnan(time)) return end;
  if (period > 0) time += period * std::floor((end + tolerance - time) / period);
  if (time < start - tolerance || time > end + tolerance) return std::nullopt;
  return std::clamp(time, start, end);
}

Eigen::Index place_of(const Points& some, const Points& all) {
  for (Eigen::Index first = 0; first + some.cols() <= all.cols(); ++first)
    if (all.middleCols(first, some.cols()) == some) return first;
  throw input_error("the run did not record the velocity at the points of these measurements");
}

}  // namespace tether
