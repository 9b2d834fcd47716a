#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "diagnosis/comparison/chances.hpp"
#include "diagnosis/noise/measured_noise.hpp"
#include "diagnosis/noise/restricted_likelihood.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

/// Products of frames in numbers that err independently, summed over these.
struct FrameProducts {
  MatrixXd sums;       ///< [frames x frames]
  double numbers = 0;  ///< summed over
  std::vector<double> times;
};

FrameProducts products_of(const NoiseField& field, const NoiseFit& fit) {
  const Index n = field.places.cols(), frames = static_cast<Index>(field.frames.size());
  MatrixXd covariance(n, n), values(n, frames);
  FrameProducts products;
  for (Index j = 0; j < n; ++j)
    for (Index i = 0; i < n; ++i)
      covariance(i, j) =
          i == j ? 1
                 : (1 - fit.nugget.value) * correlation_at((field.places.col(i) - field.places.col(j)).norm(),
                                                           fit.correlation_length.value, fit.shape);
  for (Index k = 0; k < frames; ++k) {
    values.col(k) = field.frames[static_cast<std::size_t>(k)].values;
    products.times.push_back(field.frames[static_cast<std::size_t>(k)].time);
  }
  const Eigen::LLT<MatrixXd> factor(covariance);
  factor.matrixL().solveInPlace(values);
  products.sums = values.transpose() * values;
  products.numbers = static_cast<double>(n - field.free.cols());
  if (field.free.cols() == 0) return products;
  const MatrixXd free = factor.matrixL().solve(field.free), made = free.transpose() * values;
  products.sums -= made.transpose() * (free.transpose() * free).ldlt().solve(made);
  return products;
}

/// Errors that fade as exp(-T/tau).
MatrixXd alike_over(const std::vector<double>& times, double tau) {
  const auto n = static_cast<Index>(times.size());
  MatrixXd alike = MatrixXd::Identity(n, n);
  for (Index i = 0; i < n && tau > 0; ++i)
    for (Index j = 0; j < n; ++j)
      if (i != j)
        alike(i, j) =
            std::exp(-std::abs(times[static_cast<std::size_t>(i)] - times[static_cast<std::size_t>(j)]) / tau);
  return alike;
}

/// The variance as fits best.
double log_likelihood(const std::vector<FrameProducts>& all, double tau) {
  double log_determinant = 0, squares = 0, count = 0;
  for (const FrameProducts& one : all) {
    const Index n = one.sums.rows();
    const Eigen::LLT<MatrixXd> factor(alike_over(one.times, tau));
    log_determinant += one.numbers * 2 * factor.matrixLLT().diagonal().array().log().sum();
    squares += factor.solve(one.sums).trace();
    count += one.numbers * static_cast<double>(n);
  }
  return -0.5 * (log_determinant + count * std::log(squares / count));  // (D.23)
}

/// The shortest and the longest time between two frames of a field.
std::pair<double, double> apart(const std::vector<FrameProducts>& all) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const FrameProducts& one : all)
    for (std::size_t i = 0; i < one.times.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double between = std::abs(one.times[i] - one.times[j]);
        least = std::min(least, between), most = std::max(most, between);
      }
  return {least, most};
}

/// Frames whose errors are independent would tell as much of what does not change.
double independent_frames(const std::vector<FrameProducts>& all, double tau) {
  double count = 0;
  for (const FrameProducts& one : all) {
    const VectorXd ones = VectorXd::Ones(one.sums.rows());
    count += ones.dot(alike_over(one.times, tau).llt().solve(ones));
  }
  return count;
}

constexpr double inside = 1.92;  ///< below the largest by no more: within the 95 % interval

}  // namespace

std::optional<LastingErrors> lasting_errors(const std::vector<NoiseField>& fields, const NoiseFit& fit, double stated) {
  std::vector<FrameProducts> all;
  for (const NoiseField& field : fields)
    if (field.frames.size() >= 3) all.push_back(products_of(field, fit));
  if (all.empty()) return std::nullopt;
  const auto [least, most] = apart(all);
  if (least <= 0) return std::nullopt;
  std::vector<std::pair<double, double>> known{{0, log_likelihood(all, 0)}};
  for (double tau = least / 5; tau < 3 * most; tau *= 1.05) known.emplace_back(tau, log_likelihood(all, tau));
  const auto best =
      std::max_element(known.begin(), known.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  MeasuredNumber time{best->first, best->first, best->first};
  for (const auto& [tau, value] : known)
    if (value > best->second - inside) time.lower = std::min(time.lower, tau), time.upper = std::max(time.upper, tau);
  return LastingErrors{time, chi_square_tail(std::max(0.0, 2 * (best->second - log_likelihood(all, stated))), 1),
                       independent_frames(all, stated) / independent_frames(all, time.value)};
}

}  // namespace tether
