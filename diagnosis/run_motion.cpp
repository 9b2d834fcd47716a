#include "diagnosis/run_motion.hpp"

#include <algorithm>
#include <cmath>

namespace tether {

std::optional<double> time_in_run(double time, double period, double start, double end, double tolerance) {
  if (std::isnan(time)) return end;
  if (period > 0) time += period * std::floor((end + tolerance - time) / period);
  if (time < start - tolerance || time > end + tolerance) return std::nullopt;
  return std::clamp(time, start, end);
}

}  // namespace tether
