#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace tether {

/// A difference of misfits above this tells rivals apart.
inline constexpr double convincing_difference = 6;
/// An expected difference above this tells rivals apart with 80 % probability: the difference has the variance of four
/// times its mean.
inline constexpr double telling = 12;
/// That a difference is convincing of which this is expected. (D.15)
inline double chance_to_tell(double expected) {
  const double z = (convincing_difference - expected) / (2 * std::sqrt(std::max(expected, 1e-300)));
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

/// A measurement that could be made besides, and what it would tell of rivals.
struct FurtherDatum {
  static constexpr const char* type_name = "further_datum";
  std::string measurement, assuming;
  double expected_difference = 0, probability = 0;
  bool tells = false;

  static void fields(auto& self, auto&& field) {
    field("measurement", self.measurement, "what would be measured");
    field("assuming", self.assuming, "its noise and times");
    field("expected_difference", self.expected_difference, "of the misfits of the worst pair of rivals");
    field("probability", self.probability, "that it would tell them apart");
    field("tells", self.tells, "whether that tells them apart with 80 % probability");
  }
};

/// The best one, and all others.
struct FurtherData : FurtherDatum {
  static constexpr const char* type_name = "further_data";
  std::vector<FurtherDatum> others;

  static void fields(auto& self, auto&& field) {
    FurtherDatum::fields(self, field);
    field("others", self.others, "other measurements, the best first");
  }
};

}  // namespace tether
