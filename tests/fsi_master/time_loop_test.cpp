#include "fsi_master/time_loop.hpp"

#include <gtest/gtest.h>

#include "tests/fsi_master/fakes.hpp"

namespace tether {
namespace time_loop_test {

constexpr double dt = 0.01;

/// Two fakes under a time loop.
struct Coupled {
  explicit Coupled(const fake::Vessel& vessel = {}, const std::string& method = "automatic", int halvings = 3)
      : fluid(vessel),
        solid(vessel),
        coupling(make_coupling(method, fluid, solid, {})),
        loop(fluid, solid, *coupling, VectorXd::Ones(vessel.wet()), halvings) {}
  StepRecord advance(int step) { return loop.advance(step, step * dt, dt); }
  fake::Fluid fluid;
  fake::Solid solid;
  std::unique_ptr<Coupling> coupling;
  TimeLoop loop;
};

/// Records every step that is begun; fails those that `fails` names.
fake::Trouble noting(std::vector<std::pair<double, double>>& begun, std::function<bool(double, double)> fails) {
  return [&begun, fails](double time, double step) {
    begun.emplace_back(time, step);
    if (fails(time, step)) throw StepFailure("fluid: element 7 is inverted");
  };
}

TEST(TimeLoop, FailedStepIsDoneInHalvesThenTheFullStepReturns) {
  Coupled coupled;
  std::vector<std::pair<double, double>> begun;
  coupled.fluid.trouble = noting(begun, [](double time, double step) { return time == dt && step == dt; });
  coupled.advance(0);
  const StepRecord record = coupled.advance(1);
  coupled.advance(2);
  const std::vector<std::pair<double, double>> expected{
      {0, dt}, {dt, dt}, {dt, dt / 2}, {dt + dt / 2, dt / 2}, {2 * dt, dt}};
  EXPECT_EQ(begun, expected);
  EXPECT_EQ(record.parts, 2);
  ASSERT_EQ(record.failures.size(), 1u);
  EXPECT_EQ(told(record.failures), "time 0.01 s, step 0.01 s: fluid: element 7 is inverted");
}

TEST(TimeLoop, HalvedStepsFollowTheSolutionOfHalfSteps) {
  Coupled halved, fine;
  std::vector<std::pair<double, double>> begun;
  halved.fluid.trouble = noting(begun, [](double, double step) { return step == dt; });
  halved.advance(0);
  for (int i = 0; i < 2; ++i) fine.loop.advance(i, i * dt / 2, dt / 2);
  EXPECT_EQ(halved.loop.displacement(), fine.loop.displacement());
}

TEST(TimeLoop, OnlyTheHalfThatFailsIsHalvedAgain) {
  Coupled coupled;
  std::vector<std::pair<double, double>> begun;
  coupled.fluid.trouble =
      noting(begun, [](double time, double step) { return time == dt / 2 ? step > dt / 4 : step > dt / 2; });
  const StepRecord record = coupled.advance(0);
  EXPECT_EQ(record.parts, 3);
  const std::vector<std::pair<double, double>> expected{
      {0, dt}, {0, dt / 2}, {dt / 2, dt / 2}, {dt / 2, dt / 4}, {dt / 2 + dt / 4, dt / 4}};
  EXPECT_EQ(begun, expected);
}

TEST(TimeLoop, FailureNamesStepAndHistoryAndRestoresTheLastGoodState) {
  Coupled coupled({.ratio = 100}, "iqn_ils", 1);
  coupled.advance(0);
  const Snapshot good = coupled.loop.snapshot();
  coupled.fluid.answers_nan = true;
  try {
    coupled.advance(1);
    FAIL() << "no error";
  } catch (const RunError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("step 1 failed: time 0.01 s, step 0.01 s: a partner answered with numbers that are not finite; "
                        "residuals nan\n"),
              std::string::npos)
        << text;
    EXPECT_EQ(text.find("node"), std::string::npos) << "all are lost: " << text;
    EXPECT_NE(text.find("step 0.005 s"), std::string::npos) << text;
  }
  const Snapshot after = coupled.loop.snapshot();
  EXPECT_EQ(after.fluid, good.fluid);
  EXPECT_EQ(after.solid, good.solid);
  EXPECT_EQ(after.displacement, good.displacement);
}

/// The solid has accepted the step by then: both together are no state that could be saved or tried again.
TEST(TimeLoop, ACodeThatFailsAsTheStepIsAcceptedIsNoStepThatFailed) {
  Coupled coupled;
  coupled.advance(0);
  std::vector<std::pair<double, double>> begun;
  coupled.fluid.trouble = noting(begun, [](double, double) { return false; });
  coupled.fluid.refuses_the_end = true;
  try {
    coupled.advance(1);
    FAIL() << "no error";
  } catch (const StepFailure&) {
    FAIL() << "a failed step would be saved";
  } catch (const RunError& error) {
    EXPECT_STREQ(error.what(), "step 1, as it was accepted: no section is left");
  }
  EXPECT_EQ(begun.size(), 1u) << "is not tried in halves";
}

TEST(TimeLoop, AResumedRunGivesTheSameNumbersBitForBit) {
  for (const std::string method : {"newton_krylov", "iqn_ils"}) {
    const fake::Vessel vessel{.hardening = 2e4};
    Coupled whole(vessel, method), resumed(vessel, method);
    for (int i = 0; i < 5; ++i) whole.advance(i);
    resumed.loop.restore(whole.loop.snapshot());
    for (int i = 5; i < 9; ++i) {
      const StepRecord a = whole.advance(i), b = resumed.advance(i);
      EXPECT_EQ(a.residual, b.residual);
      EXPECT_EQ(a.fluid, b.fluid);
      EXPECT_EQ(a.solid, b.solid);
    }
    EXPECT_EQ(whole.loop.displacement(), resumed.loop.displacement()) << method;
  }
}

TEST(TimeLoop, ACodeWithoutStateIsSimulated) {
  Coupled coupled;
  coupled.fluid.with_state = false;
  for (int i = 0; i < 3; ++i) EXPECT_EQ(coupled.advance(i).parts, 1);
  EXPECT_TRUE(coupled.loop.snapshot().fluid.empty());
}

}  // namespace time_loop_test
}  // namespace tether
