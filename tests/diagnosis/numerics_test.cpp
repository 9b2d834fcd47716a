/// Runs on a finer mesh, as the nodes of a coarser one move in them.
#include "diagnosis/evidence/numerics.hpp"
#include "diagnosis/evidence/node_map.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/observation_manager/lumens.hpp"

namespace tether {
namespace {

/// A smooth motion, zero at the time 0.
Vec3 motion_at(const Vec3& x, double time) {
  return time * Vec3(0.02 * x(1), 0.03 * std::sin(x(2)), 0.01 * x(0) * x(0));
}

double worst_error(int coarse, int fine) {
  const LumenSurface lumen = testing::lumen(testing::sphere(coarse)), other = testing::lumen(testing::sphere(fine));
  FinishedMotion run;
  run.motion.imaged = other.points;
  run.motion.positions = [&](double time) {
    Points moved = other.points;
    for (Eigen::Index i = 0; i < moved.cols(); ++i) moved.col(i) += motion_at(other.points.col(i), time);
    return moved;
  };
  const FinishedMotion mapped = NodeMap(lumen, other)(run);
  EXPECT_EQ((mapped.motion.positions(0) - lumen.points).norm(), 0) << "what does not move lies where it was imaged";
  const Points moved = mapped.motion.positions(0.5);
  double worst = 0;
  for (Eigen::Index i = 0; i < moved.cols(); ++i)
    worst = std::max(worst, (moved.col(i) - lumen.points.col(i) - motion_at(lumen.points.col(i), 0.5)).norm());
  return worst;
}

TEST(Numerics, AFinerRunMovesTheNodesOfACoarserMesh) {
  const double error = worst_error(12, 16), finer = worst_error(12, 32);
  EXPECT_LT(error, 1e-3) << "of motions up to 0.02";
  EXPECT_GT(std::log2(error / finer), 1.7) << "second order";
}

/// What the model differs by from a coarser one is an error that may be as much of it; not where a run has no data.
TEST(Numerics, WhatACoarserModelDiffersByIsAllowed) {
  EffectProblem problem;
  problem.residual = (VectorXd(3) << 4, 5, 6).finished();
  problem.allowed.resize(3, 0);
  const VectorXd coarse = (VectorXd(3) << 1, 7, 6).finished();
  problem.left_by_refinement = 0.6;
  allow_numerics(problem, coarse);
  ASSERT_EQ(problem.allowed.cols(), 1);
  EXPECT_EQ(problem.allowed.col(0), (VectorXd(3) << 3, -2, 0).finished());
  EXPECT_EQ(problem.allowed_deviation, VectorXd::Constant(1, 0.6));
  EXPECT_FALSE(problem.allowed_errors[0].name.empty()) << "a person may look after it";
  allow_numerics(problem, VectorXd::Constant(3, undefined));
  EXPECT_EQ(problem.allowed.cols(), 1);
}

/// Of errors that fall as a power of the mesh's width the truth lies between those of first and of second order.
TEST(Numerics, WhatIsLeftByRefinementIsBetweenFirstAndSecondOrder) {
  for (const double ratio : {1.25, 4.0 / 3, 2.0, 3.0}) {
    std::array<double, 2> left{}, before{};
    for (const int order : {1, 2}) {
      const double coarse = std::pow(ratio, order), fine = 1, apart = coarse - fine;
      left[order - 1] = fine / apart, before[order - 1] = coarse / apart;
    }
    EXPECT_NEAR(std::log(left_by_refinement(ratio)), (std::log(left[0]) + std::log(left[1])) / 2, 1e-12);
    EXPECT_NEAR(std::log(wrong_before_refinement(ratio)), (std::log(before[0]) + std::log(before[1])) / 2, 1e-12);
  }
}

TEST(Numerics, RefiningCompetesAsAnAmplitude) {
  EffectProblem problem;
  problem.changes.resize(3, 0);
  const VectorXd change = (VectorXd(3) << 1, 2, 3).finished();
  add_numerics(problem, {"long_step", "share", {}}, change);
  ASSERT_EQ(problem.candidates.size(), 1U);
  EXPECT_EQ(problem.candidates[0].kind, Candidate::Kind::numerics);
  EXPECT_FALSE(problem.candidates[0].takes_runs());
  EXPECT_FALSE(problem.candidates[0].confirmable);
  EXPECT_TRUE(problem.amplitudes[0].one_sided) << "the limit does not lie on the other side";
  EXPECT_LE(problem.amplitudes[0].value(10), 2);
  EXPECT_EQ(problem.changes.col(0), change);
}

}  // namespace
}  // namespace tether
