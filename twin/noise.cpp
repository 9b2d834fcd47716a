#include "twin/noise.hpp"

#include <cmath>

namespace tether {
namespace {

constexpr int waves = 600;

/// exp(-dt/tau); 0 for tau = 0.
double likeness(double dt, double correlation_time) {
  return correlation_time > 0 ? std::exp(-std::abs(dt) / correlation_time) : 0.0;
}

/// Row k: the shares of independent numbers 0 .. k in the k-th of a series with variance 1 and correlation
/// exp(-dt/tau) (T.2).
Eigen::MatrixXd shares_of(const std::vector<double>& times, double correlation_time) {
  const auto n = static_cast<Eigen::Index>(times.size());
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double kept = k == 0 ? 0 : likeness(times[i] - times[i - 1], correlation_time);
    if (k > 0) shares.row(k) = kept * shares.row(k - 1);
    shares(k, k) = std::sqrt(1 - kept * kept);
  }
  return shares;
}

}  // namespace

RandomField::RandomField(double correlation_length, Random random, CorrelationShape shape) : random_(random) {
  if (correlation_length <= 0) return;
  wave_numbers_.resize(3, waves);
  cosine_.resize(waves);
  sine_.resize(waves);
  for (Eigen::Index m = 0; m < waves; ++m) {
    const Vec3 direction(random.normal(), random.normal(), random.normal());
    const double spread = shape == CorrelationShape::exponential ? std::abs(random.normal()) : 1;
    wave_numbers_.col(m) = direction / (spread * correlation_length);  // (T.1)
    cosine_[m] = random.normal() / std::sqrt(waves);
    sine_[m] = random.normal() / std::sqrt(waves);
  }
}

VectorXd RandomField::white(Eigen::Index count) const {
  Random random = random_;
  return VectorXd::NullaryExpr(count, [&] { return random.normal(); });
}

VectorXd RandomField::operator()(const Points& x) const {
  if (wave_numbers_.cols() == 0) return white(x.cols());
  VectorXd values(x.cols());
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Eigen::ArrayXd phase = wave_numbers_.transpose() * x.col(i);
    values[i] = (cosine_.array() * phase.cos() + sine_.array() * phase.sin()).sum();
  }
  return values;
}

NoiseSeries::NoiseSeries(const NoiseScale& scale, const std::vector<double>& times, std::uint64_t seed)
    : deviation_(scale.deviation), shares_(shares_of(times, scale.correlation_time)) {
  if (deviation_ > 0)
    for (std::size_t frame = 0; frame < times.size(); ++frame)
      fields_.emplace_back(scale.correlation_length, Random(seed, frame));
}

VectorXd NoiseSeries::operator()(std::size_t frame, const Points& x) const {
  VectorXd noise = VectorXd::Zero(x.cols());
  for (std::size_t k = 0; k <= frame && k < fields_.size(); ++k) {
    const double share = shares_(static_cast<Eigen::Index>(frame), static_cast<Eigen::Index>(k));
    if (share > 1e-6) noise += deviation_ * share * fields_[k](x);
  }
  return noise;
}

VectorXd noise_over_time(const NoiseScale& scale, const std::vector<double>& times, std::uint64_t seed) {
  Random random(seed, 0);
  const auto n = static_cast<Eigen::Index>(times.size());
  VectorXd noise(n);
  double last = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double kept = k == 0 ? 0 : likeness(times[i] - times[i - 1], scale.correlation_time);
    last = kept * last + std::sqrt(1 - kept * kept) * random.normal();  // (T.2)
    noise[k] = scale.deviation * last;
  }
  return noise;
}

}  // namespace tether
