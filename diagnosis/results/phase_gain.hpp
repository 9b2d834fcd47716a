#pragma once

namespace tether {

/// How much better each moment's data are foretold from those of all other moments. (D.21)
struct PhaseGain {
  static constexpr const char* type_name = "phase_gain";
  double value = 0, deviation = 0;
  int moments = 0, better = 0;
  double positive = 0, robust = 0;

  static void fields(auto& self, auto&& field) {
    field("value", self.value, "logarithm of probability, summed over the moments");
    field("deviation", self.deviation, "of the value, as the moments differ");
    field("moments", self.moments, "that were left out, one after the other");
    field("better", self.better, "of these, how many are foretold better");
    field("positive", self.positive, "probability that there is any gain");
    field("robust", self.robust, "of the value, without the fifth of the moments that say most for it");
  }
};

}  // namespace tether
