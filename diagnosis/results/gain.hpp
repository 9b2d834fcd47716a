#pragma once

#include <optional>

namespace tether {

/// By how much a change of the model lessens the distance to data, with a 95 % interval.
struct Gain {
  static constexpr const char* type_name = "gain";
  double value = 0, lower = 0, upper = 0;
  double before = 0, after = 0;
  double positive = 0;

  static void fields(auto& self, auto&& field) {
    field("value", self.value, "1 - rms after / rms before");
    field("lower", self.lower, "of its 95 % interval");
    field("upper", self.upper, "of its 95 % interval");
    field("before", self.before, "root mean square, in the noise's deviation");
    field("after", self.after, "root mean square, in the noise's deviation");
    field("positive", self.positive, "probability that there is any gain");
  }
};

/// Whether the change takes the model away from the data, whatever the draw.
inline bool is_refuted(const std::optional<Gain>& gain) {
  return gain && gain->upper < 0;
}

}  // namespace tether
