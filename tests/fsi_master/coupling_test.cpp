#include "fsi_master/coupling.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "common/base/effect.hpp"
#include "fsi_master/convergence.hpp"
#include "fsi_master/extrapolation.hpp"
#include "fsi_master/newton_memory.hpp"
#include "tests/fsi_master/fakes.hpp"

namespace tether {
namespace coupling_test {

constexpr double tolerance = 1e-6;
constexpr double dt = 0.01;

enum class Method { operators, tangents, black_box };

struct Steps {
  std::vector<CouplingResult> results;
  Motion last;
  double evaluations(std::size_t from = 0) const { return mean(from, &CouplingResult::evaluations); }
  double krylov(std::size_t from = 0) const { return mean(from, &CouplingResult::krylov_iterations); }
  double mean(std::size_t from, int CouplingResult::*count) const {
    double sum = 0;
    for (std::size_t i = from; i < results.size(); ++i) sum += results[i].*count;
    return sum / static_cast<double>(results.size() - from);
  }
};

/// Their squares are infinite, and so is what would be asked for.
TEST(Convergence, NumbersBeyondMeasureAreNotConverged) {
  for (const double number : {1e160, 1e290, infinite, undefined}) {
    const StepStart start{0, 0, dt, VectorXd::Zero(6), VectorXd::Zero(6)};
    const CouplingOptions options;
    Convergence convergence(options, start);
    EXPECT_FALSE(convergence.reached(VectorXd::Ones(6), VectorXd::Constant(6, number))) << number;
    EXPECT_FALSE(convergence.may_continue());
    const CouplingResult result = std::move(convergence).result({});
    EXPECT_FALSE(result.converged);
    EXPECT_NE(result.failure.find(std::isfinite(number) ? "too large" : "not finite"), std::string::npos)
        << result.failure;
  }
}

Steps run(const fake::Vessel& vessel, Method method, int steps, CouplingOptions options = {}) {
  fake::Fluid fluid(vessel);
  fake::Solid solid(vessel);
  solid.operators = method == Method::operators;
  solid.tangent = method != Method::black_box;
  const auto coupling = make_coupling("automatic", fluid, solid, options);
  Steps all;
  StepStart start{0, 0, dt, VectorXd::Zero(vessel.wet()), VectorXd::Zero(vessel.wet())};
  for (int i = 0; i < steps; ++i) {
    fluid.begin_step(start).get();
    solid.begin_step(start).get();
    all.results.push_back(coupling->solve_step(start));
    EXPECT_TRUE(all.results.back().converged) << "step " << i << ": " << all.results.back().failure;
    fluid.end_step(true).get();
    solid.end_step(true).get();
    all.last = all.results.back().motion;
    start = {i + 1, start.time + dt, dt, all.last.displacement, all.last.velocity};
  }
  return all;
}

/// The step solved to round-off.
VectorXd exact_velocity(const fake::Vessel& vessel) {
  CouplingOptions tight;
  tight.tolerance = 1e-13;
  tight.max_iterations = 60;
  return run(vessel, Method::tangents, 1, tight).last.velocity;
}

class AddedMass : public ::testing::TestWithParam<fake::Vessel> {};

TEST_P(AddedMass, AllMethodsEndOnTheSameStep) {
  const VectorXd exact = exact_velocity(GetParam());
  for (const Method method : {Method::operators, Method::tangents, Method::black_box}) {
    const VectorXd V = run(GetParam(), method, 1).last.velocity;
    EXPECT_LT((V - exact).norm(), 10 * tolerance * exact.norm()) << "method " << static_cast<int>(method);
  }
}

INSTANTIATE_TEST_SUITE_P(RatiosAndSprings, AddedMass,
                         ::testing::Values(fake::Vessel{.ratio = 10}, fake::Vessel{.ratio = 100},
                                           fake::Vessel{.ratio = 10, .hardening = 2e4},
                                           fake::Vessel{.ratio = 100, .hardening = 2e4}));

TEST(NewtonKrylov, NeedsTwoEvaluationsOfALinearVessel) {
  const Steps heavy = run({.ratio = 10}, Method::operators, 60);
  EXPECT_EQ(heavy.evaluations(), 2.0);
  EXPECT_LE(heavy.krylov(), 10.0);
  const Steps heavier = run({.ratio = 100}, Method::operators, 60);
  EXPECT_LE(heavier.evaluations(), 2.1);
  EXPECT_LE(heavier.krylov(), 16.0);
}

TEST(NewtonKrylov, NeedsThreeEvaluationsOfAHardeningVesselWithTheFirstFactorKept) {
  const Steps steps = run({.ratio = 10, .hardening = 2e4}, Method::operators, 60);
  EXPECT_LE(steps.evaluations(), 3.0);
  EXPECT_LE(steps.krylov(), 20.0);
}

TEST(NewtonTangents, TakeAsManyEvaluationsAsOperators) {
  const Steps steps = run({.ratio = 10}, Method::tangents, 60);
  EXPECT_EQ(steps.evaluations(), 2.0);
  EXPECT_LE(steps.krylov(), 10.0);
}

TEST(NewtonMemory, IsOfStepsOfOneSize) {
  NewtonMemory memory;
  StepStart start;
  start.dt = 0.1;
  memory.begin(start);
  memory.directions().note(VectorXd::Unit(4, 0), 3 * VectorXd::Unit(4, 0));
  memory.directions().learn();
  memory.first_correction_left(1e-3);
  memory.begin(start);
  EXPECT_EQ(memory.directions().directions(), 1);
  EXPECT_DOUBLE_EQ(memory.left_of(2), 2e-3);
  NewtonMemory other;
  other.unpack(memory.packed());
  EXPECT_EQ(other.packed(), memory.packed());
  start.dt = 0.05;
  memory.begin(start);
  EXPECT_EQ(memory.directions().directions(), 0);
  EXPECT_EQ(memory.left_of(2), 0);
}

TEST(Convergence, ALinearSolveThatDidHardlyAnythingEndsTheLoop) {
  const CouplingOptions options;
  const StepStart start{0, 0, dt, VectorXd::Zero(3), VectorXd::Zero(3)};
  Convergence slow(options, start), useless(options, start);
  slow.note({false, 100, 0.05});  // not what was asked for, but a step forward
  EXPECT_TRUE(slow.may_continue());
  useless.note({false, 100, 0.5});
  EXPECT_FALSE(useless.may_continue());
  const CouplingResult result = std::move(useless).result({});
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.krylov_iterations, 100);
  EXPECT_EQ(result.failure, "the linear equations of a correction kept 0.5 of their residual in 100 iterations");
}

/// No linear solve goes further than a share of what the correction leaves anyway.
TEST(Convergence, ALinearSolveGoesNoFurtherThanItIsOfUse) {
  const CouplingOptions options;
  const Convergence convergence(options, {0, 0, dt, VectorXd::Zero(3), VectorXd::Zero(3)});
  const VectorXd V = VectorXd::Constant(3, 10), r = VectorXd::Constant(3, 1);
  EXPECT_DOUBLE_EQ(convergence.linear_target(V, r), 0.3e-6 * V.norm());
  EXPECT_DOUBLE_EQ(convergence.linear_target(V, r, 1e-7 * V.norm()), 0.3e-6 * V.norm());
  EXPECT_DOUBLE_EQ(convergence.linear_target(V, r, 1e-3), 0.3e-3);
}

TEST(IqnIls, ReusedStepsHalveTheEvaluations) {
  const auto evaluations = [](int reuse) {
    CouplingOptions options;
    options.reuse = reuse;
    return run({.ratio = 10}, Method::black_box, 60, options).evaluations();
  };
  EXPECT_LE(evaluations(0), 10.5);
  EXPECT_LE(evaluations(5), 6.0);
  EXPECT_LE(evaluations(10), 4.5);
}

TEST(Coupling, AVesselAtRestIsConvergedAtOnce) {
  for (const Method method : {Method::operators, Method::tangents, Method::black_box}) {
    const fake::Vessel vessel;
    fake::Fluid fluid(vessel);
    fake::Solid solid(vessel);
    solid.operators = method == Method::operators;
    solid.tangent = method != Method::black_box;
    const StepStart start{0, -dt, dt, VectorXd::Zero(vessel.wet()), VectorXd::Zero(vessel.wet())};  // pressure sin(0)
    fluid.begin_step(start).get();
    solid.begin_step(start).get();
    const CouplingResult result = make_coupling("automatic", fluid, solid, {})->solve_step(start);
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.evaluations, 1);
    EXPECT_EQ(result.krylov_iterations, 0);
  }
}

TEST(Coupling, NumbersThatAreNotFiniteEndTheLoopAndNameTheNode) {
  for (const Method method : {Method::operators, Method::tangents, Method::black_box}) {
    const fake::Vessel vessel{.stiffness = 0, .clamped = false};
    fake::Fluid fluid(vessel);
    fake::Solid solid(vessel);
    fluid.answers_nan = true;
    solid.operators = method == Method::operators;
    solid.tangent = method != Method::black_box;
    const StepStart start{0, 0, dt, VectorXd::Zero(vessel.wet()), VectorXd::Zero(vessel.wet())};
    fluid.begin_step(start).get();
    solid.begin_step(start).get();
    const CouplingResult result = make_coupling("automatic", fluid, solid, {})->solve_step(start);
    EXPECT_FALSE(result.converged);
    EXPECT_EQ(result.evaluations, 1);
    EXPECT_NE(result.failure.find("not finite"), std::string::npos) << result.failure;
  }
}

TEST(Convergence, NamesANodeUnlessAllAreLost) {
  const StepStart start{0, 0, dt, VectorXd::Zero(12), VectorXd::Zero(12)};
  const CouplingOptions options;
  const auto worst = [&](const VectorXd& residual) {
    Convergence convergence(options, start);
    convergence.reached(VectorXd::Ones(12), residual);
    return std::move(convergence).result({}).worst_node;
  };
  VectorXd residual = VectorXd::LinSpaced(12, 0, 1);
  EXPECT_EQ(worst(residual), 3);
  residual(4) = std::nan("");
  EXPECT_EQ(worst(residual), 1);
  EXPECT_EQ(worst(VectorXd::Constant(12, std::nan(""))), -1);
}

TEST(Coupling, NotConvergingIsAResultWithItsHistory) {
  CouplingOptions options;
  options.max_iterations = 3;
  const fake::Vessel vessel;
  fake::Fluid fluid(vessel);
  fake::Solid solid(vessel);
  const StepStart start{0, 0, dt, VectorXd::Zero(vessel.wet()), VectorXd::Zero(vessel.wet())};
  fluid.begin_step(start).get();
  solid.begin_step(start).get();
  const CouplingResult result = make_coupling("iqn_ils", fluid, solid, options)->solve_step(start);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.residuals.size(), 3u);
  EXPECT_EQ(result.failure, "not converged to 1e-06 after 3 evaluations");
  EXPECT_GE(result.worst_node, 0);
}

TEST(MakeCoupling, ChoosesByWhatTheCodesAnnounce) {
  const fake::Vessel vessel;
  fake::Fluid fluid(vessel);
  fake::Solid solid(vessel);
  EXPECT_EQ(make_coupling("automatic", fluid, solid, {})->name(), "newton_krylov");
  EXPECT_EQ(make_coupling("iqn_ils", fluid, solid, {})->name(), "iqn_ils");
  fluid.tangent = false;
  EXPECT_EQ(make_coupling("automatic", fluid, solid, {})->name(), "iqn_ils");
  EXPECT_THROW(make_coupling("newton_krylov", fluid, solid, {}), InputError);
}

void expect_to_go_on_from_memory(const std::string& method) {
  const fake::Vessel vessel{.hardening = 2e4};
  fake::Fluid fluid(vessel);
  fake::Solid solid(vessel);
  const auto first = make_coupling(method, fluid, solid, {}), second = make_coupling(method, fluid, solid, {});
  StepStart start{0, 0, dt, VectorXd::Zero(vessel.wet()), VectorXd::Zero(vessel.wet())};
  const auto step = [&](Coupling& coupling, bool accept) {
    fluid.begin_step(start).get();
    solid.begin_step(start).get();
    CouplingResult result = coupling.solve_step(start);
    fluid.end_step(accept).get();
    solid.end_step(accept).get();
    return result;
  };
  const Motion motion = step(*first, true).motion;
  start = {1, dt, dt, motion.displacement, motion.velocity};
  second->set_memory(first->memory());
  const CouplingResult a = step(*first, false), b = step(*second, false);
  EXPECT_EQ(a.residuals, b.residuals) << method;
  EXPECT_EQ(a.motion.velocity, b.motion.velocity) << method;
}

TEST(Coupling, GoesOnFromItsMemoryBitForBit) {
  for (const char* method : {"newton_krylov", "iqn_ils"}) expect_to_go_on_from_memory(method);
}

StepStart step_of(double dt) {
  StepStart start;
  start.dt = dt;
  return start;
}

TEST(Extrapolation, IsOfStepsOfOneSizeWithoutFailure) {
  Extrapolation extrapolation;
  EXPECT_EQ(extrapolation.begin(step_of(0.1)).size(), 0);
  extrapolation.end(VectorXd::Constant(3, 2));
  EXPECT_EQ(extrapolation.begin(step_of(0.1)), VectorXd::Constant(3, 2));
  EXPECT_EQ(extrapolation.begin(step_of(0.1)).size(), 0) << "the step before did not end";
  extrapolation.end(VectorXd::Constant(3, 2));
  EXPECT_EQ(extrapolation.begin(step_of(0.05)).size(), 0);
}

TEST(Extrapolation, TakesLessOfAChangeThatRings) {
  Extrapolation extrapolation;
  const auto after = [&](double first, double second) {
    extrapolation.begin(step_of(0.1));
    extrapolation.begin(step_of(0.1));
    extrapolation.end(VectorXd::Constant(3, first));
    extrapolation.begin(step_of(0.1));
    extrapolation.end(VectorXd::Constant(3, second));
    return extrapolation.begin(step_of(0.1))[0];
  };
  EXPECT_DOUBLE_EQ(after(2, 4), 4);
  EXPECT_DOUBLE_EQ(after(2, 1.5), 0.75);
  EXPECT_DOUBLE_EQ(after(2, -2), 0);
}

/// Changes that repeat themselves, ring, or do both at once, are foreseen from two of them.
TEST(Extrapolation, ForeseesTwoModes) {
  std::srand(7);
  const VectorXd slow = VectorXd::Random(12), ringing = VectorXd::Random(12);
  const auto change = [&](int k) -> VectorXd { return std::pow(0.95, k) * slow + std::pow(-0.9, k) * ringing; };
  Extrapolation extrapolation;
  double worst = 0;
  for (int k = 0; k < 30; ++k) {
    const VectorXd guess = extrapolation.begin(step_of(0.1));
    if (k > 10) worst = std::max(worst, (guess - change(k)).norm() / change(k).norm());
    extrapolation.end(change(k));
    if (k == 15) {
      const std::vector<double> kept = extrapolation.packed();
      Extrapolation other;
      other.unpack(kept.data(), kept.data() + kept.size());
      EXPECT_EQ(other.packed(), kept);
      extrapolation = other;
    }
  }
  EXPECT_LT(worst, 0.01);
}

}  // namespace coupling_test
}  // namespace tether
