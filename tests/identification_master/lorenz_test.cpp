#include <gtest/gtest.h>

#include <random>

#include "identification_master/reduced_order_filter.hpp"

namespace tether {
namespace {

constexpr int places = 40;
constexpr double dt = 0.02;

/// Lorenz 1996: dx_i/dt = (x_(i+1) - x_(i-2)) x_(i-1) - c x_i + F, chaotic at F = 8, c = 1.
VectorXd rate(const VectorXd& x, double F, double c) {
  VectorXd dx(places);
  for (int i = 0; i < places; ++i)
    dx(i) = (x((i + 1) % places) - x((i + places - 2) % places)) * x((i + places - 1) % places) - c * x(i) + F;
  return dx;
}

VectorXd stepped(const VectorXd& x, double F, double c) {
  const VectorXd a = rate(x, F, c), b = rate(x + dt / 2 * a, F, c), d = rate(x + dt / 2 * b, F, c),
                 e = rate(x + dt * d, F, c);
  return x + dt / 6 * (a + 2 * b + 2 * d + e);
}

/// Forcing and damping from every second place, with errors, over 1.2 units of time from a known start: within three
/// stated deviations of the truth, and these deviations a fraction of the prior's.
TEST(Lorenz, ForcingAndDampingAreFound) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const double F = 8, c = 1, deviation = 0.3;
  VectorXd truth = VectorXd::Constant(places, F);
  truth(0) += 1;
  for (int spin_up = 0; spin_up < 300; ++spin_up) truth = stepped(truth, F, c);

  const Eigen::Vector2d prior(6.5, 1.3);
  ReducedOrderFilter filter(prior, Eigen::Vector2d(1.5 * 1.5, 0.3 * 0.3).asDiagonal().toDenseMatrix());
  MatrixXd X = truth.replicate(1, 3);
  double chi_square = 0;
  int data = 0;
  for (int step = 0; step < 60; ++step) {
    truth = stepped(truth, F, c);
    MatrixXd D(places / 2, 3);
    for (int i = 0; i < 3; ++i) X.col(i) = stepped(X.col(i), filter.particles()(0, i), filter.particles()(1, i));
    for (int k = 0; k < places / 2; ++k) {
      const double y = truth(2 * k) + deviation * normal(random);
      for (int i = 0; i < 3; ++i) D(k, i) = y - X(2 * k, i);
    }
    const auto done = filter.correct(D, VectorXd::Constant(places / 2, 1 / (deviation * deviation)));
    X = (X * done.mix.transpose()).eval();
    chi_square += done.chi_square;
    data += places / 2;
  }
  const VectorXd deviations = filter.covariance().diagonal().cwiseSqrt();
  EXPECT_LT(std::abs(filter.mean()(0) - F), 3 * deviations(0));
  EXPECT_LT(std::abs(filter.mean()(1) - c), 3 * deviations(1));
  EXPECT_LT(deviations(0), 0.1);
  EXPECT_LT(deviations(1), 0.02);
  EXPECT_NEAR(chi_square / data, 1, 0.15);
}

}  // namespace
}  // namespace tether
