/// Runs that begin their steps as another did: the same motion, for less work.
#include "fsi_master/run_guide.hpp"

#include <gtest/gtest.h>

#include "fsi_master/time_loop.hpp"
#include "tests/fsi_master/fakes.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace run_guide_test {

constexpr double dt = 0.01, tolerance = 1e-8;
constexpr int steps = 30;

struct Course {
  MatrixXd displacements;  ///< a column a step
  int evaluations = 0;
};

/// A run of two fakes. trouble: what goes wrong in it. operators: whether the solid shows its equations.
Course run(const fake::Vessel& vessel, RunGuide* guide, const fake::Trouble& trouble = {}, bool operators = true) {
  fake::Fluid fluid(vessel);
  fake::Solid solid(vessel);
  solid.trouble = trouble;
  solid.operators = operators;
  const auto coupling = make_coupling("newton_krylov", fluid, solid, {tolerance});
  coupling->follow(guide);
  TimeLoop loop(fluid, solid, *coupling, VectorXd::Ones(vessel.wet()), 3);
  Course all{MatrixXd(vessel.wet(), steps)};
  for (int step = 1; step <= steps; ++step) {
    all.evaluations += loop.advance(step, (step - 1) * dt, dt).evaluations;
    all.displacements.col(step - 1) = loop.displacement();
  }
  return all;
}

double distance(const Course& one, const Course& other) {
  return (one.displacements - other.displacements).norm() / other.displacements.norm();
}

class Guided : public ::testing::Test {
 protected:
  Course guide(const fake::Trouble& trouble = {}, bool operators = true) {
    RunGuide guide(folder.path(), RunGuide::Role::guide, dt);
    return run(known, &guide, trouble, operators);
  }
  Course follower(const fake::Vessel& vessel, bool operators = true) {
    RunGuide guide(folder.path(), RunGuide::Role::follower, dt);
    return run(vessel, &guide, {}, operators);
  }
  TemporaryFolder folder;
  fake::Vessel known{.hardening = 2e4}, stiffer{.stiffness = 420, .hardening = 2e4};
};

TEST_F(Guided, ARunThatIsTheSameIsThereAtOnce) {
  const Course first = guide(), again = follower(known);
  EXPECT_LT(distance(again, first), 100 * tolerance);
  EXPECT_LT(again.evaluations, 2 * steps) << "the changes are kept in single precision";
  EXPECT_LT(again.evaluations, first.evaluations);
}

TEST_F(Guided, AnotherRunIsWhatItIsForLess) {
  for (const bool operators : {true, false}) {
    guide({}, operators);
    const Course alone = run(stiffer, nullptr, {}, operators), guided = follower(stiffer, operators);
    EXPECT_LT(distance(guided, alone), 100 * tolerance) << operators;
    EXPECT_LT(guided.evaluations, alone.evaluations) << operators;
  }
}

TEST_F(Guided, StepsThatTheGuideHalvedAreForeseenWithoutIt) {
  guide([](double time, double step) {
    if (std::abs(time - 10 * dt) < 1e-9 && step == dt) throw StepFailure("too far");
  });
  RunGuide kept(folder.path(), RunGuide::Role::follower, dt);
  const auto known_in = [&](std::int64_t step, double size) {
    StepStart start;
    start.step = step;
    start.dt = size;
    return kept.change_in(start).size() > 0;
  };
  EXPECT_TRUE(known_in(10, dt));
  EXPECT_FALSE(known_in(11, dt));
  EXPECT_TRUE(known_in(12, dt));
  EXPECT_FALSE(known_in(12, dt / 2));
  EXPECT_FALSE(known_in(steps + 1, dt));
  EXPECT_LT(distance(follower(stiffer), run(stiffer, nullptr)), 100 * tolerance);
}

TEST_F(Guided, WithoutAGuideARunGoesItsOwnWay) {
  const Course alone = run(stiffer, nullptr), without = follower(stiffer);
  EXPECT_EQ(without.displacements, alone.displacements);
  EXPECT_EQ(without.evaluations, alone.evaluations);
}

}  // namespace run_guide_test
}  // namespace tether
