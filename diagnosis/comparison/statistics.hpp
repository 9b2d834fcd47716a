#pragma once

#include <array>
#include <vector>

#include "observation_manager/measurements/lumen_series.hpp"

namespace tether {

/// What the signed distances of a group of samples amount to (D.1). All zero without samples.
struct Statistics {
  std::array<int, exclusion_count> counts{};  ///< of samples by reason of exclusion; the first: those used
  double extent = 0;                          ///< what they stand for: area [length^2] or length [length]
  double rms = 0;                             ///< root of the mean square [length]
  double unnormalised = 0;                    ///< root of the integral of the square [length^2 or length^1.5]
  double largest = 0;                         ///< of |d| [length]
  double mean = 0;                            ///< signed: positive where the data lie outside the model [length]
  double p95 = 0;                             ///< 95 % of the extent has |d| below this [length]
  int used() const { return counts[0]; }
};

/// Collects samples, of one frame or of many.
class Distances {
 public:
  void add(const Sample& sample);
  Statistics statistics() const;

 private:
  struct Weighted {
    double distance, weight;
  };
  std::array<int, exclusion_count> counts_{};
  std::vector<Weighted> used_;
};

/// How many independent observations `samples` errors amount to that are alike within a correlation length (D.2).
/// `extent`: the area or length that they cover; `dimension`: 2 for areas, 1 for lengths, or durations with a
/// correlation time. At least 1 if there is a sample.
double effective_number(double extent, int dimension, double correlation, int samples);

}  // namespace tether
