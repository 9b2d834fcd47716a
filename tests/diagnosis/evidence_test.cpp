// Data of every kind as evidence, datum by datum.
#include "diagnosis/evidence/evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnosis/evidence/data_errors.hpp"
#include "diagnosis/evidence/patterns.hpp"
#include "tests/observation_manager/measured_samples.hpp"

namespace tether::testing {
namespace {

/// Two points in three frames, the second held out; off the run by 1 and -2. The last point lies outside at 0.5.
VelocitySeries velocities(const SimpleRun& run, double correlation_length = 0) {
  const Points points{{0, 0.5}, {0, 0}, {1, 1}};
  std::vector<VelocityFrame> frames;
  for (const double time : sample_times) {
    Components values(1, 2);
    values << run.velocity(time) + 1, run.velocity(time) - 2;
    frames.push_back({time, time == 0.3, values});
  }
  return {{"pc_mr", Vec3::UnitZ().transpose(), 0, 0.005, {2, correlation_length, 0}}, points, frames};
}

FinishedMotion one_point_lost(const SimpleRun& run) {
  FinishedMotion finished = run.finished();
  finished.velocity = [whole = finished.velocity](const Points& at, double time) {
    Points all = whole(at, time);
    if (time > 0.4) all.col(1).setConstant(std::nan(""));
    return all;
  };
  return finished;
}

TEST(Evidence, VelocitiesAreDataLikeOthers) {
  const SimpleRun run, other{2};
  const LumenSurface lumen = SimpleRun::imaged();
  Observations data;
  data.velocities.push_back(velocities(run));
  const FinishedMotion base = one_point_lost(run), elsewhere = other.finished();
  const Evidence evidence(data, lumen, base);
  ASSERT_EQ(evidence.parts().size(), 3U);
  EXPECT_EQ(evidence.name_of(evidence.parts()[0]), "pc_mr");
  EXPECT_EQ(evidence.field_of(evidence.parts()[0]), "observations.velocities.pc_mr");
  const EffectProblem problem = evidence.problem();
  EXPECT_LT((problem.residual - (VectorXd(6) << 1, -2, 1, -2, 1, 0).finished()).norm(), 1e-12);
  EXPECT_LT((problem.precision - (VectorXd(6) << 1, 1, 1, 1, 1, 0).finished() / 4).norm(), 1e-12)
      << "1/sigma^2; nothing outside the lumen";
  EXPECT_EQ(problem.training, (std::vector<Eigen::Index>{0, 1, 4}));
  EXPECT_EQ(problem.held_out, (std::vector<Eigen::Index>{2, 3}));
  EXPECT_EQ(problem.block, (std::vector<int>{0, 1, 2, 3, 4, 5})) << "each point by itself";
  const MatrixXd residuals = evidence.residuals({&base, &elsewhere});
  EXPECT_TRUE(std::isnan(residuals(5, 0)));
  EXPECT_NEAR(residuals(5, 1), -12, 1e-12);
  EXPECT_NEAR(residuals(0, 1), -9, 1e-12);
}

TEST(Evidence, VelocitiesThatErrTogetherCountAsFewer) {
  const SimpleRun run;
  const LumenSurface lumen = SimpleRun::imaged();
  Observations data;
  data.velocities.push_back(velocities(run, 0.5));
  const EffectProblem problem = Evidence(data, lumen, run.finished()).problem();
  const double number = 4 / (2 + 2 * std::exp(-1.0));
  EXPECT_NEAR(problem.independent.head(2).sum(), number, 1e-12);
  EXPECT_NEAR(problem.precision.head(2).sum(), number / 4, 1e-12);
  EXPECT_EQ(problem.block[0], problem.block[1]) << "within four correlation lengths";
}

/// A pressure at the phase of a held-out plane of velocities is held out with it.
TEST(Evidence, RecordsFollowTheClosestFrameOfWhateverKind) {
  const SimpleRun run;
  const LumenSurface lumen = SimpleRun::imaged();
  Observations data;
  data.velocities.push_back(velocities(run));
  const std::vector<double> times{0.1, 0.25, 0.35, 0.5};
  const std::vector<double> values{1100, 1250, 1350, 1500};
  data.traces.push_back({"cuff", "fluid.outlet.pressure", times, values, Curve(times, values), {50, 0, 0}});
  const Evidence evidence(data, lumen, run.finished());
  ASSERT_EQ(evidence.parts().size(), 4U);
  EXPECT_EQ(evidence.name_of(evidence.parts()[3]), "cuff");
  const EffectProblem problem = evidence.problem();
  EXPECT_EQ(problem.held_out, (std::vector<Eigen::Index>{2, 3, 7, 8}));
  EXPECT_EQ(problem.block[7], problem.block[8]);
  EXPECT_NE(problem.block[6], problem.block[7]);
}

/// Displacements and bad thresholds are errors of images: of these data there are none, and no patterns of the wall.
TEST(Evidence, FaultsAreOnlyThoseThatDataCanHave) {
  const SimpleRun run;
  const LumenSurface lumen = SimpleRun::imaged();
  Observations data;
  data.velocities.push_back(velocities(run));
  const FinishedMotion base = run.finished();
  const Evidence evidence(data, lumen, base);
  EffectProblem problem = evidence.problem();
  const AllowanceCase allowed;
  add_data_errors(problem, evidence, base, allowed, UnitSystem::cgs());
  add_patterns(problem, evidence, allowed, 0, 0.8);
  EXPECT_TRUE(problem.candidates.empty());
  EXPECT_EQ(problem.allowed.cols(), 0);
  EXPECT_EQ(problem.patterns.cols(), 0);
}

}  // namespace
}  // namespace tether::testing
