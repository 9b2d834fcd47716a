#pragma once

#include "observation_manager/measurements/measurement.hpp"

namespace tether {

/// Measured minus the run's over all data that this run has. All zero without any.
struct OtherStatistics {
  int used = 0;
  double rms = 0, largest = 0, bias = 0;
};

/// A source of a kind that no one but its own file knows, set against a run: number beside number.
struct OtherDiscrepancy {
  std::string name, kind, unit;
  Noise noise;
  OtherStatistics training, held_out;
};

/// Needs a part of the run for each thing that the source asks for.
OtherDiscrepancy compare(const Measurement& data, const FinishedMotion& run, const UnitSystem& units);

/// "pullback (pressure_drops): 3.1 g/(cm s2) off in root mean square over 24 values (1.2 times the noise)"
std::vector<std::string> sentences_of(const OtherDiscrepancy& other);

}  // namespace tether
