#include "diagnosis/comparison/registration.hpp"

#include <gtest/gtest.h>

#include <set>

#include "diagnosis/comparison/comparison.hpp"
#include "diagnosis/evidence/curvature.hpp"
#include "diagnosis/evidence/data_errors.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "observation_manager/measurements/observations.hpp"
#include "tests/diagnosis/beating_tube.hpp"

namespace tether::testing {
namespace registration_test {

constexpr double noise = 0.02;

/// The beating tube, its data displaced and turned about the middle of the vessel.
Observations moved_data(const Vec3& displacement, const Vec3& rotation) {
  const LumenSurface surface = beating_lumen();
  SourceSettings settings = beating_settings(surface, {noise, 0.5, 0});
  std::vector<SurfaceFrame> frames;
  const Vec3 middle(0, 0, 2);
  const Eigen::AngleAxisd turn(rotation.norm(), rotation.norm() > 0 ? Vec3(rotation.normalized()) : Vec3::UnitX());
  for (int i = 0; i < 8; ++i) {
    TriangleSurface moved = tube_at(i / 8.0);
    for (auto point : moved.points.colwise()) point = turn * (point - middle) + middle + displacement;
    frames.push_back({i / 8.0, moved, {}});
  }
  Observations data;
  data.lumen.push_back(std::make_unique<SurfaceSeries>(settings, frames, std::vector<bool>(8, false), surface));
  return data;
}

/// The beating tube against these data, with what they may err in.
EffectProblem problem_of(const Observations& data) {
  const LumenSurface surface = beating_lumen();
  const FinishedMotion base{beating_run(1), {}};
  const Evidence evidence(data, surface, base);
  EffectProblem problem = evidence.problem();
  add_data_errors(problem, evidence, base, {}, UnitSystem::cgs());
  return problem;
}

TEST(Registration, FindsHowDataAreDisplacedAndTurned) {
  const Vec3 by(0.08, -0.05, 0), turn(0.03, 0.02, 0);
  const Observations data = moved_data(by, turn);
  const auto found = compare(*data.lumen[0], std::vector<std::string>{"right", "left"}, beating_run(1)).registration;
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->stands_out());
  EXPECT_LT((found->motion.displacement - by).norm(), 0.05 * by.norm());
  EXPECT_LT((found->motion.rotation - turn).norm(), 0.05 * turn.norm());
  EXPECT_LT(found->after, 0.1 * found->before);
  const Comparison comparison = compare(data, std::vector<std::string>{"right", "left"}, {beating_run(1), {}, {}});
  EXPECT_NE(sentences_of(comparison).front().find("CHECK THE REGISTRATION"), std::string::npos);
}

TEST(Registration, IsNoNewsOfDataThatBeatElsewhereOrLieRight) {
  const Observations data = moved_data({0, 0, 0}, {0, 0, 0});
  RunMotion run = beating_run(1, Vec3(0.2, 0, 0));  // the model moves aside: of the data that says nothing
  run.imaged = tube_at(0).points;
  const auto found = compare(*data.lumen[0], std::vector<std::string>{"right", "left"}, run).registration;
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->stands_out());
}

TEST(Registration, NeedsANoise) {
  EXPECT_FALSE(registration_of({}, noise, 10));
  const Observations data = moved_data({0, 0, 0}, {0, 0, 0});
  const auto samples = data.lumen[0]->observe(tube_at(0).points, data.lumen[0]->frames().front());
  EXPECT_FALSE(registration_of(samples, 0, 10));
  EXPECT_TRUE(registration_of(samples, noise, 10));
}

TEST(Curvatures, OfATubeAndOfABarrel) {
  const LumenSurface straight = lumen(tube(48, 24, 4, [](double) { return 0.8; }));
  const VectorXd of_tube = curvatures(straight);
  EXPECT_LT((of_tube.array() - 1 / 0.8).abs().maxCoeff(), 0.01 / 0.8);
  double error[2];
  for (const int k : {0, 1}) {  // a zone of a sphere of radius 3
    const LumenSurface barrel =
        lumen(tube(48 << k, 24 << k, 4, [](double z) { return std::sqrt(9 - (z - 2) * (z - 2)); }));
    const VectorXd all = curvatures(barrel);
    error[k] = 0;
    for (Eigen::Index i = 0; i < all.size(); ++i)
      if (const double z = barrel.points(2, i); z > 0.5 && z < 3.5)
        error[k] = std::max(error[k], std::abs(all(i) - 2.0 / 3));
  }
  EXPECT_LT(error[0], 0.02 * 2 / 3);
  EXPECT_LT(error[1], 0.3 * error[0]) << "of second order";
}

/// What turned data look like competes as a candidate; about its own axis a round tube shows nothing.
TEST(DataErrors, OfTurnedDataAreTheirDistances) {
  const EffectProblem problem = problem_of(moved_data({0, 0, 0}, {0, 0.02, 0}));
  const auto turned = std::find_if(problem.candidates.begin(), problem.candidates.end(),
                                   [](const Candidate& c) { return c.name == "misrotation"; });
  ASSERT_NE(turned, problem.candidates.end());
  ASSERT_EQ(turned->amplitudes.size(), 2U) << "about x and y";
  EXPECT_EQ(problem.amplitudes[static_cast<std::size_t>(turned->amplitudes[1])].name, "about_y");
  const VectorXd expected = 0.02 * problem.changes.col(turned->amplitudes[1]);
  double off = 0, all = 0;
  for (const Eigen::Index i : problem.training)
    off += std::pow(problem.residual(i) - expected(i), 2), all += std::pow(problem.residual(i), 2);
  EXPECT_LT(off, 0.01 * all);
}

/// Of data that the model was made of, none are displaced as a whole; one frame may be.
TEST(DataErrors, AreNoneOfAllFramesWhereOneIsTheImagedLumen) {
  const EffectProblem problem = problem_of(moved_data({0, 0, 0}, {0, 0, 0}));
  std::set<std::string> names;
  for (const Candidate& candidate : problem.candidates) names.insert(candidate.name);
  EXPECT_EQ(names, (std::set<std::string>{"gating_shift", "misplaced_frame", "mistimed_frame"}));
  EXPECT_EQ(problem.allowed.cols(), 4) << "displacement and bias are allowed";
}

}  // namespace registration_test
}  // namespace tether::testing
