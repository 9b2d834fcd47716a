#include "fluid/windkessels/fit_elements.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "common/base/error.hpp"
#include "tests/windkessels/beats.hpp"

namespace tether {
namespace {

const std::vector<double> shares{0.148, 0.046, 0.106, 0.7};

OutletTargets targets_of(double mean, double pulse, double proximal_share) {
  OutletTargets targets{mean, pulse, {"a", "b", "c", "d"}, shares, {}};
  for (const double r : resistances(mean, shares, testing::beat_of_a_heart()))
    targets.proximals.push_back(proximal_share * r);
  return targets;
}

std::string refusal(const OutletTargets& targets) {
  try {
    fit_to_pulse(targets, testing::beat_of_a_heart());
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FitToPulse, MakesMeanPulseAndSplit) {
  const PeriodicFlow flow = testing::beat_of_a_heart();
  const PeriodicFlow fine = flow.refined({}, 1000);
  for (const double pulse : {20.0, 40.0, 90.0}) {
    const std::vector<Windkessel> outlets = fit_to_pulse(targets_of(93, pulse, 0.03), flow);
    const PeriodicBeat beat = periodic_beat(outlets, fine);
    EXPECT_NEAR(beat.mean_pressure(), 93, 1e-3);
    EXPECT_NEAR(beat.pulse_pressure(), pulse, 1e-6 * pulse);
    PeriodicBeat one = beat;
    for (Eigen::Index i = 0; i < 4; ++i) {
      one.pressure = beat.flow.row(i);
      EXPECT_NEAR(one.mean_pressure() / flow.mean(), shares[static_cast<std::size_t>(i)], 1e-6);
    }
  }
}

/// With proximal resistances of their own, outlets differ in shape; mean and pulse are met all the same, and so is the
/// split of the mean flow.
TEST(FitToPulse, TakesProximalResistancesOfEachOutlet) {
  const PeriodicFlow flow = testing::beat_of_a_heart();
  OutletTargets targets = targets_of(93, 45, 0.03);
  targets.proximals = {0.4, 0.9, 0.3, 0.08};
  const std::vector<Windkessel> outlets = fit_to_pulse(targets, flow);
  PeriodicBeat beat = periodic_beat(outlets, flow.refined({}, 1000));
  EXPECT_NEAR(beat.mean_pressure(), 93, 1e-3);
  EXPECT_NEAR(beat.pulse_pressure(), 45, 1e-4);
  beat.pressure = beat.flow.row(1);
  EXPECT_NEAR(beat.mean_pressure() / flow.mean(), 0.046, 1e-6);
}

/// A vessel that stores by itself leaves less to its outlets, down to nothing.
TEST(FitToPulse, LeavesTheVesselItsPart) {
  const PeriodicFlow flow = testing::beat_of_a_heart();
  OutletTargets targets = targets_of(93, 40, 0.03);
  const double alone = fit_to_pulse(targets, flow)[0].compliance;
  targets.vessel = 0.5;
  const std::vector<Windkessel> outlets = fit_to_pulse(targets, flow);
  const PeriodicBeat beat = periodic_beat(outlets, flow.refined({}, 1000), 0.5);
  EXPECT_NEAR(beat.mean_pressure(), 93, 1e-2);
  EXPECT_NEAR(beat.pulse_pressure(), 40, 1e-3);
  EXPECT_LT(outlets[0].compliance, alone);
  targets.vessel = 50;
  EXPECT_NE(refusal(targets).find("vessel_compliance: "), std::string::npos) << refusal(targets);
}

/// The pulse pressure falls as the compliance grows: bisection finds the only one.
TEST(FitToPulse, PulseFallsWithCompliance) {
  const PeriodicFlow flow = testing::beat_of_a_heart().refined({}, 500);
  double before = 1e9;
  for (double compliance = 1e-4; compliance < 1e3; compliance *= 1.5) {
    const Windkessel one{0.05, 1.1, compliance};
    const double pulse = periodic_beat({&one, 1}, flow).pulse_pressure();
    EXPECT_LT(pulse, before * (1 + 1e-12)) << compliance;
    before = pulse;
  }
  const Windkessel one{0.05, 1.1, 1};
  const ReachablePulse reachable = reachable_pulse({&one, 1}, flow);
  EXPECT_NEAR(before, reachable.least, 0.01 * reachable.least);
  const Windkessel stiff{0.05, 1.1, 1e-7};
  EXPECT_NEAR(periodic_beat({&stiff, 1}, flow).pulse_pressure(), reachable.most, 1e-3 * reachable.most);
}

TEST(FitToPulse, TellsWhatCanBeReached) {
  const double swing = testing::beat_of_a_heart().most();
  EXPECT_NE(refusal(targets_of(93, 5000, 0.056)).find(fmt::format("it is {:.4g} mmHg without", 93 / 80.0 * swing)),
            std::string::npos)
      << refusal(targets_of(93, 5000, 0.056));
  EXPECT_NE(
      refusal(targets_of(93, 20, 0.056)).find(fmt::format("and {:.4g} mmHg with an infinite", 0.056 * 93 / 80 * swing)),
      std::string::npos)
      << refusal(targets_of(93, 20, 0.056));
  OutletTargets narrow = targets_of(93, 40, 0.05);
  narrow.proximals[1] = 1e3;
  EXPECT_NE(refusal(narrow).find("outlets.b: its proximal resistance"), std::string::npos) << refusal(narrow);
}

/// Elements that made a pressure are found from it, from samples at other times than the flow's.
TEST(FitToCurve, FindsTheElementsThatMadeIt) {
  const PeriodicFlow flow = testing::beat_of_a_heart();
  for (const Windkessel& truth : {Windkessel{0.06, 1.1, 1.3}, Windkessel{0.02, 2.0, 0.4}, Windkessel{0.2, 0.6, 3.0}}) {
    MeasuredPressure measured;
    for (int i = 0; i < 90; ++i) measured.times.push_back(0.8 * i / 90);
    const PeriodicFlow fine = flow.refined(measured.times, 2);
    const PeriodicBeat made = periodic_beat({&truth, 1}, fine);
    for (const double time : measured.times) {
      const auto at = std::lower_bound(fine.times.begin(), fine.times.end(), time - 1e-9);
      measured.values.push_back(made.pressure[at - fine.times.begin()]);
    }
    const CurveFit fit = fit_to_curve(measured, flow);
    EXPECT_NEAR(fit.whole.proximal, truth.proximal, 1e-6 * truth.proximal);
    EXPECT_NEAR(fit.whole.distal, truth.distal, 1e-6 * truth.distal);
    EXPECT_NEAR(fit.whole.compliance, truth.compliance, 1e-6 * truth.compliance);
    EXPECT_LT(fit.misfit, 1e-5);
  }
}

}  // namespace
}  // namespace tether
