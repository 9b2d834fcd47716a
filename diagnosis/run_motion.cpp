#include "diagnosis/run_motion.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "common/io/lumen_motion.hpp"

namespace tether {

RunMotion stored_motion(const std::filesystem::path& folder) {
  const auto stored = std::make_shared<const LumenMotion>(folder / "lumen.motion");
  return {stored->times().front(), stored->times().back(), stored->imaged(),
          [stored](double time) { return stored->at(time); }};
}

std::optional<double> time_in_run(double time, double period, double start, double end, double tolerance) {
  if (std::isnan(time)) return end;
  if (period > 0) time += period * std::floor((end + tolerance - time) / period);
  if (time < start - tolerance || time > end + tolerance) return std::nullopt;
  return std::clamp(time, start, end);
}

}  // namespace tether
