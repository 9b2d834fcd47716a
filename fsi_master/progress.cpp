#include "fsi_master/progress.hpp"

#include <fmt/format.h>

namespace tether {

std::string text_of(const StepNews& news, const UnitSystem& units) {
  std::string text = fmt::format("t {:.4g} s  coupling {}", news.time, news.evaluations);
  if (!news.pressure.empty())
    text += fmt::format("  pressure {:.1f} .. {:.1f} mmHg", units.to_mmhg(news.pressure.min),
                        units.to_mmhg(news.pressure.max));
  return text + fmt::format("  moved {:.3g} mm", units.to_mm(news.displacement));
}

}  // namespace tether
