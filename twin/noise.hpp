#pragma once

#include "common/base/types.hpp"
#include "diagnosis/results/noise.hpp"
#include "twin/random.hpp"

/// Errors as a segmenter makes them: alike at neighbouring places and moments.
namespace tether {

/// A random function of the place with mean 0, variance 1 and a correlation, exp(-r/l) (D.2) if nothing else is said,
/// as a sum of waves whose numbers are drawn from that correlation's spectrum (T.1) (Rahimi and Recht 2007). l = 0:
/// alike nowhere.
class RandomField {
 public:
  RandomField(double correlation_length, Random random, CorrelationShape shape = CorrelationShape::exponential);
  /// At one column each.
  VectorXd operator()(const Points& x) const;

 private:
  VectorXd white(Eigen::Index count) const;

  Random random_;
  Points wave_numbers_;     ///< none for l = 0 [1/length]
  VectorXd cosine_, sine_;  ///< amplitudes
};

/// The standard deviation of errors, and how far they reach.
struct NoiseScale {
  double deviation = 0, correlation_length = 0, correlation_time = 0;
};

/// Errors of a series of frames: of each frame the field of the one before, faded by exp(-dt/tau), and a new one (T.2).
class NoiseSeries {
 public:
  NoiseSeries(const NoiseScale& scale, const std::vector<double>& times, std::uint64_t seed);
  /// Of a frame at these places [length].
  VectorXd operator()(std::size_t frame, const Points& x) const;

 private:
  double deviation_;
  std::vector<RandomField> fields_;
  Eigen::MatrixXd shares_;  ///< of each field in each frame
};

/// Errors of values at `times`: the same in time only.
VectorXd noise_over_time(const NoiseScale& scale, const std::vector<double>& times, std::uint64_t seed);

}  // namespace tether
