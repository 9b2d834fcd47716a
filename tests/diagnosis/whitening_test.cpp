// Data as numbers that err independently.
#include "diagnosis/evidence/whitening.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "tests/observation_manager/measured_samples.hpp"

namespace tether::testing {
namespace {

constexpr int points = 30, components = 2;
constexpr double deviation = 2, nugget = 0.15;

/// Two components at points on a line 3 long, in three frames, the second held out.
struct Line {
  Line(double length, double duration) {
    Points at(3, points);
    for (int i = 0; i < points; ++i) at.col(i) = Vec3(0.1 * i, 0, 0);
    std::vector<VelocityFrame> frames;
    for (const double time : sample_times)
      frames.push_back({time, time == 0.3, Components::Random(components, points)});
    Components axes = Components::Zero(components, 3);
    axes(0, 0) = axes(1, 1) = 1;
    data.velocities.emplace_back(VelocitySeries::Settings{"pc_mr", axes, 0, 0.005, {deviation, length, duration}}, at,
                                 frames);
  }

  SimpleRun run;
  LumenSurface lumen = SimpleRun::imaged();
  FinishedMotion base = run.finished();
  Observations data;
};

/// As the noise was stated: exponential in space and in time, each component by itself, 15 % of it of no extent.
MatrixXd covariance_of(const Evidence& evidence, double length, double duration) {
  const auto n = evidence.places().cols();
  MatrixXd all(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
      const double apart = (evidence.places().col(i) - evidence.places().col(j)).norm(),
                   later = std::abs(evidence.times()[a] - evidence.times()[b]);
      const double in_time = duration > 0 ? std::exp(-later / duration) : (later == 0 ? 1 : 0);
      const bool alike = evidence.components()[a] == evidence.components()[b];
      all(i, j) = deviation * deviation * (i == j ? 1 : alike ? (1 - nugget) * std::exp(-apart / length) * in_time : 0);
    }
  return all;
}

TEST(Whitening, ErrorsBecomeIndependentAndOfDeviationOne) {
  for (const double duration : {0.0, 0.4}) {
    const Line line(0.5, duration);
    const Evidence evidence(line.data, line.lumen, line.base);
    const Whitening whitening(evidence, evidence.problem());
    const MatrixXd errors = covariance_of(evidence, 0.5, duration).llt().matrixL();
    const MatrixXd white = whitening(errors);
    EXPECT_LT((white * white.transpose() - MatrixXd::Identity(white.rows(), white.rows())).norm(), 1e-9)
        << "errors that last " << duration;
  }
}

TEST(Whitening, KeepsWhatIsKnownOfLongWaves) {
  const Line line(0.5, 0);
  const Evidence evidence(line.data, line.lumen, line.base);
  EffectProblem problem = evidence.problem();
  const auto n = problem.residual.size();
  problem.changes = MatrixXd::Zero(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double x = evidence.places()(0, i);
    problem.changes.row(i) << 1, std::cos(2 * M_PI * x / 3);
  }
  const Whitening whitening(evidence, problem);
  const EffectProblem white = whitening(problem);
  const MatrixXd precise = covariance_of(evidence, 0.5, 0).llt().solve(problem.changes);
  for (Eigen::Index k = 0; k < 2; ++k) {
    const double exact = problem.changes.col(k).dot(precise.col(k)), kept = white.changes.col(k).squaredNorm();
    EXPECT_LT(kept, exact * (1 + 1e-9));
    EXPECT_GT(kept, 0.99 * exact);
  }
  EXPECT_EQ(white.training.size() + white.held_out.size(), static_cast<std::size_t>(white.residual.size()));
  EXPECT_LT(white.training.back(), white.held_out.front());
  EXPECT_GT(white.independent.sum(), problem.independent.sum()) << "waves of twice the errors' extent count as well";
  EXPECT_LT(white.independent.sum(), static_cast<double>(n));
}

/// One number each, known as well as it was.
TEST(Whitening, LeavesIndependentErrorsAlone) {
  const Line line(0, 0);
  const Evidence evidence(line.data, line.lumen, line.base);
  const EffectProblem problem = evidence.problem(), white = Whitening(evidence, problem)(problem);
  EXPECT_EQ(white.residual.size(), problem.residual.size());
  EXPECT_NEAR(white.residual.norm(), problem.residual.norm() / deviation, 1e-12);
  EXPECT_EQ(white.independent.sum(), static_cast<double>(problem.residual.size()));
}

TEST(Whitening, ARunThatFailedStaysSo) {
  const Line line(0.5, 0);
  const Evidence evidence(line.data, line.lumen, line.base);
  const EffectProblem problem = evidence.problem();
  MatrixXd residuals(problem.residual.size(), 2);
  residuals << problem.residual, VectorXd::Constant(problem.residual.size(), undefined);
  const MatrixXd white = Whitening(evidence, problem)(residuals);
  EXPECT_TRUE(white.col(0).allFinite());
  EXPECT_TRUE(white.col(1).array().isNaN().all());
}

}  // namespace
}  // namespace tether::testing
