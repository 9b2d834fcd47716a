#pragma once

#include <filesystem>

#include "diagnosis/noise/measured_noise.hpp"
#include "diagnosis/noise/seen_noise.hpp"

namespace tether {

/// Measures what was seen. unit: of lengths, as a case file has it; empty: unknown.
MeasuredNoise measured_noise(const SeenNoise& seen, const std::string& unit);

/// Measures each. What pairs of neighbouring frames show is not held against a statement where what a run leaves of
/// the same source says that errors last from one to the next.
std::vector<MeasuredNoise> measured_noise(const std::vector<SeenNoise>& seen, const std::string& unit);

/// Sentences for people, one for each measurement, and one for each statement that it contradicts.
std::vector<std::string> sentences_of(const std::vector<MeasuredNoise>& measurements);

std::string text_of(const NoiseMeasurements& noise);

/// Correlation against distance, as it was measured and as the fits have it: OUTPUT/plots/noise_*.png, one for each
/// measurement. Returns the names; none without gnuplot.
std::vector<std::string> draw_noise(const NoiseMeasurements& noise, const std::filesystem::path& output);

}  // namespace tether
