#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/io/record.hpp"

namespace tether {

/// How errors a distance r apart are alike; of the same length l they count as the same number of independent ones.
enum class CorrelationShape { exponential, gaussian };

template <>
inline constexpr auto words_of<CorrelationShape> = std::to_array<WordOf<CorrelationShape>>({
    {CorrelationShape::exponential, "exponential", "exp(-r/l)"},
    {CorrelationShape::gaussian, "gaussian", "exp(-r^2/(2 l^2))"},
});

/// What noise was measured from.
enum class NoiseOrigin { repeated, rest, residual };

template <>
inline constexpr auto words_of<NoiseOrigin> = std::to_array<WordOf<NoiseOrigin>>({
    {NoiseOrigin::repeated, "repeated", "two segmentations of the same moment"},
    {NoiseOrigin::rest, "rest", "neighbouring frames between which the model hardly moves"},
    {NoiseOrigin::residual, "residual", "what a run of the model leaves"},
});

/// A number with a 95 % interval.
struct MeasuredNumber {
  static constexpr const char* type_name = "measured_number";
  double value = 0, lower = 0, upper = 0;

  static void fields(auto& self, auto&& field) {
    field("value", self.value, "median");
    field("lower", self.lower, "of the 95 % interval");
    field("upper", self.upper, "of the 95 % interval");
  }
};

/// Noise of one shape, as data have it.
struct NoiseFit {
  static constexpr const char* type_name = "noise_fit";
  CorrelationShape shape = CorrelationShape::exponential;
  MeasuredNumber deviation, correlation_length, nugget;
  double log_likelihood = 0;

  static void fields(auto& self, auto&& field) {
    field("shape", self.shape, "of the correlation");
    field("deviation", self.deviation, "of a datum, all of it, in `unit`");
    field("correlation_length", self.correlation_length, "in `unit`");
    field("nugget", self.nugget, "share of the variance that is not alike even between neighbours");
    field("log_likelihood", self.log_likelihood, "restricted, the largest");
  }
};

/// Products of errors this far apart, over the variance.
struct CorrelationBin {
  static constexpr const char* type_name = "correlation_bin";
  double distance = 0, pairs = 0, measured = 0, exponential = 0, gaussian = 0;

  static void fields(auto& self, auto&& field) {
    field("distance", self.distance, "mean, in `unit`");
    field("pairs", self.pairs, "of data");
    field("measured", self.measured, "correlation of what is left of the data");
    field("exponential", self.exponential, "what the exponential fit expects there");
    field("gaussian", self.gaussian, "what the Gaussian fit expects there");
  }
};

/// What a case states of a source's noise, held against what was measured.
struct NoiseCheck {
  static constexpr const char* type_name = "noise_check";
  std::string source;
  double deviation = 0, correlation_length = 0, correlation_time = 0;
  MeasuredNumber deviation_ratio, length_ratio;
  std::optional<MeasuredNumber> measured_time;
  double p = 1;
  bool contradicts = false, time_contradicts = false;

  static void fields(auto& self, auto&& field) {
    field("source", self.source, "in the case");
    field("deviation", self.deviation, "as stated, in the case's unit");
    field("correlation_length", self.correlation_length, "as stated, in the case's unit");
    field("correlation_time", self.correlation_time, "as stated [s]; 0: errors do not last");
    field("deviation_ratio", self.deviation_ratio,
          "measured over stated; of neighbouring frames: over what of it does not last from one to the next");
    field("length_ratio", self.length_ratio, "measured over stated");
    field("measured_time", self.measured_time, "in which errors fade to a share 1/e [s]; null: not measurable");
    field("p", self.p, "probability that noise as stated looks so much like another one");
    field("contradicts", self.contradicts,
          "deviation or length are too improbable, and off by so much that it matters");
    field("time_contradicts", self.time_contradicts, "so is the time");
  }
};

/// The noise of one source, measured in one way.
struct MeasuredNoise {
  static constexpr const char* type_name = "measured_noise";
  NoiseOrigin from = NoiseOrigin::residual;
  std::string source;
  std::vector<std::string> frames;
  int points = 0, independent = 0;
  std::string unit;
  std::vector<NoiseFit> fits;
  double shape_difference = 0;
  bool shape_is_told = false, reaches_end = false;
  std::optional<MeasuredNumber> correlation_time;
  std::optional<double> shown;
  std::vector<CorrelationBin> correlation;
  std::string line;
  std::optional<NoiseCheck> stated;

  static void fields(auto& self, auto&& field) {
    field("from", self.from, "what it was measured from");
    field("source", self.source, "in the case, or the files");
    field("frames", self.frames, "that were used");
    field("points", self.points, "data of a frame");
    field("independent", self.independent, "all data, less numbers that were left free");
    field("unit", self.unit, "of lengths");
    field("fits", self.fits, "of each shape, the likelier first");
    field("shape_difference", self.shape_difference, "of the two log likelihoods");
    field("shape_is_told", self.shape_is_told, "the data tell which shape it is");
    field("reaches_end", self.reaches_end, "the interval of the length ends where the vessel does");
    field("correlation_time", self.correlation_time, "[s]; null: not measurable");
    field("shown", self.shown,
          "share of the variance that pairs of neighbouring frames show, of errors that last as what the run leaves "
          "says; null: all, or unknown");
    field("correlation", self.correlation, "by distance");
    field("line", self.line,
          "to paste into the source's section of the case; empty: errors last, which these frames hide");
    field("stated", self.stated, "what the case states, held against it");
  }
};

/// Noise of a case's data: noise.json (docs/noise.md).
struct NoiseMeasurements {
  static constexpr const char* type_name = "noise";
  std::string case_name;
  std::vector<std::string> sentences;
  std::vector<MeasuredNoise> measurements;

  static void fields(auto& self, auto&& field) {
    field("case", self.case_name, "name of the case; of files their names");
    field("sentences", self.sentences, "what a person should know");
    field("measurements", self.measurements, "each source, each way in which it can be measured");
  }
};

bool is_contradicted(const NoiseCheck& check);
/// "observations.surfaces.mri: the stated noise contradicts the data: ..."
std::string sentence_of(const NoiseCheck& check);

}  // namespace tether
