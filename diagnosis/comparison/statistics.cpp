#include "diagnosis/comparison/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tether {

void Distances::add(const Sample& sample) {
  ++counts_[static_cast<std::size_t>(sample.excluded)];
  if (sample.excluded == Exclusion::none) used_.push_back({sample.distance, sample.weight});
}

Statistics Distances::statistics() const {
  Statistics result;
  result.counts = counts_;
  double sum = 0, squares = 0;
  std::vector<Weighted> ascending = used_;
  for (Weighted& one : ascending) {
    result.extent += one.weight;
    sum += one.weight * one.distance;
    squares += one.weight * one.distance * one.distance;
    one.distance = std::abs(one.distance);
  }
  if (result.extent == 0) return result;
  std::sort(ascending.begin(), ascending.end(),
            [](const Weighted& a, const Weighted& b) { return a.distance < b.distance; });
  result.mean = sum / result.extent;  // (D.1)
  result.rms = std::sqrt(squares / result.extent);
  result.unnormalised = std::sqrt(squares);
  result.largest = ascending.back().distance;
  double below = 0;
  for (const Weighted& one : ascending) {
    below += one.weight;
    result.p95 = one.distance;
    if (below >= 0.95 * result.extent * (1 - 1e-12)) break;
  }
  return result;
}

double effective_number(double extent, int dimension, double correlation, int samples) {
  if (samples == 0) return 0;
  if (correlation <= 0) return samples;
  const double alike = dimension == 2 ? 2 * std::numbers::pi * correlation * correlation : 2 * correlation;  // (D.2)
  return std::clamp(extent / alike, 1.0, static_cast<double>(samples));
}

}  // namespace tether
