#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/io/record.hpp"

namespace tether {

/// How a beat of a run differs from the one before, at the same phases.
struct BeatChange {
  static constexpr const char* type_name = "beat_change";
  std::int64_t beat = 0;
  double pressure = 0, volume = 0;

  static void fields(auto& self, auto&& field) {
    field("beat", self.beat, "its number; the first one is 1");
    field("pressure", self.pressure,
          "largest change at an inlet against the beat before, over the mean absolute pressure there");
    field("volume", self.volume, "largest change of the lumen against the beat before, over its mean");
  }
};

/// Whether a run of several beats has become periodic.
struct Periodicity {
  static constexpr const char* type_name = "periodicity";
  double period = 0, limit = 0;
  std::vector<BeatChange> beats;
  std::optional<std::int64_t> periodic_from;

  static void fields(auto& self, auto&& field) {
    field("period", self.period, "of the inlets' curves [s]");
    field("limit", self.limit, "a beat that changes both by no more is periodic");
    field("beats", self.beats, "complete ones, from the second on");
    field("periodic_from", self.periodic_from, "the first periodic beat; null: none yet");
  }
};

}  // namespace tether
