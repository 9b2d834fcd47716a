#include "observation_manager/measurements/independence.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tether {

double independent_part(const Noise& noise, int dimension, double observed) {
  const double l = noise.correlation_length, part = dimension == 2 ? 2 * std::numbers::pi * l * l : 2 * l;
  return observed > 0 ? std::min(part, observed) : part;
}

double independent_share(double apart, double correlation_time) {
  return correlation_time > 0 && apart > 0 ? std::tanh(apart / (2 * correlation_time)) : 1;
}

double spacing(const std::vector<double>& times, double period) {
  if (times.size() < 2) return infinite;
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  return period > 0 ? period / static_cast<double>(times.size())
                    : (*last - *first) / static_cast<double>(times.size() - 1);
}

double effective_points(const Points& points, double correlation_length) {
  const auto count = static_cast<double>(points.cols());
  if (correlation_length <= 0) return count;
  double sum = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    sum += (-(points.colwise() - points.col(i)).colwise().norm().array() / correlation_length).exp().sum();
  return count * count / sum;  // (D.6)
}

}  // namespace tether
