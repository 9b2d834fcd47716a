#pragma once

#include <algorithm>
#include <string>

namespace tether {

/// Whether what is left is noise and errors that are allowed: the probability that those leave as much by chance, asked
/// in five ways. (D.20)
struct Adequacy {
  static constexpr const char* type_name = "adequacy";
  double whole = 1, pooled = 1, local = 1, errors = 1, held_out = 1;

  /// That one of the five answers is as improbable by chance.
  double p() const { return std::min(1.0, 5 * std::min({whole, pooled, local, errors, held_out})); }

  static void fields(auto& self, auto&& field) {
    field("whole", self.whole, "of the misfit of all training data");
    field("pooled", self.pooled, "of what regions, moments and forms are off by together");
    field("local", self.local, "of the region, moment and form that is farthest off");
    field("errors", self.errors, "of the allowed error that would have to be largest");
    field("held_out", self.held_out, "of the misfit of held-out data, given the training data");
  }
};

/// How large the noise of a source is, as its data say.
struct NoiseFactor {
  static constexpr const char* type_name = "noise_factor";
  std::string source;
  double factor = 1, long_waves = 1;

  static void fields(auto& self, auto&& field) {
    field("source", self.source, "field of the case");
    field("factor", self.factor, "deviation that was taken over what is stated, 1 to 1.3");
    field("long_waves", self.long_waves,
          "that of its long waves, 1 to 2: larger where errors are alike farther than stated");
  }
};

}  // namespace tether
