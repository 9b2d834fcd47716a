#include "common/base/periodic_fit.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.hpp"

namespace tether {
namespace {

constexpr double huber = 1.345;  // of the deviation: 95 % efficiency under normal errors (Holland and Welsch 1977)
constexpr double median_of_normal = 0.6745;  // median of |error| over the deviation
constexpr int reweightings = 50;

double median(VectorXd values) {
  auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

PeriodicFit::PeriodicFit(std::span<const double> times, const MatrixXd& values, double period, int harmonics)
    : period_(period), harmonics_(harmonics) {
  const auto samples = static_cast<Eigen::Index>(times.size());
  TETHER_ASSERT(values.cols() == samples, "{} samples at {} times", values.cols(), samples);
  MatrixXd design(samples, 2 * harmonics + 1);
  for (Eigen::Index i = 0; i < samples; ++i) design.row(i) = waves(times[static_cast<std::size_t>(i)]).transpose();
  if (const auto rank = Eigen::ColPivHouseholderQR<MatrixXd>(design).rank(); rank < design.cols())
    throw input_error("{} harmonics need {} different phases of the period of {}; there are {}", harmonics,
                      design.cols(), period, rank);
  VectorXd weights = VectorXd::Ones(samples);
  for (int pass = 0; pass <= reweightings; ++pass) {
    const VectorXd roots = weights.cwiseSqrt();
    coefficients_ = (roots.asDiagonal() * design)
                        .colPivHouseholderQr()
                        .solve((values * roots.asDiagonal()).transpose())
                        .transpose();
    const VectorXd left = (values - coefficients_ * design.transpose()).colwise().norm();
    residual_ = std::sqrt(left.squaredNorm() / static_cast<double>(samples));
    const double limit = huber * median(left) / median_of_normal;
    const VectorXd next = left.unaryExpr([&](double l) { return l > limit ? limit / l : 1.0; });
    if ((next - weights).cwiseAbs().maxCoeff() < 1e-10) break;
    weights = next;
  }
}

VectorXd PeriodicFit::waves(double time) const {
  VectorXd result(2 * harmonics_ + 1);
  result[0] = 1;
  for (int k = 1; k <= harmonics_; ++k) {
    const double angle = 2 * std::numbers::pi * k * time / period_;
    result[2 * k - 1] = std::cos(angle);
    result[2 * k] = std::sin(angle);
  }
  return result;
}

}  // namespace tether
