// When a run of several beats is periodic.
#include "fsi_master/periodicity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

constexpr double T = 0.9;

/// A beat about means of 100 and 150 whose distance from the periodic state halves with every beat: at the same phase
/// the largest change in beat k is `first` 2^-(k-1), at its beginning.
BeatingRun settling(double first, double dt, int beats) {
  BeatingRun run;
  run.pressures.resize(1);
  for (int i = 1; i * dt <= beats * T * (1 + 1e-12); ++i) {
    const double t = i * dt, wave = std::sin(2 * std::numbers::pi * t / T), left = std::exp2(-t / T);
    run.times.push_back(t);
    run.pressures[0].push_back(100 + 20 * wave + 2 * first * left);
    run.volumes.push_back(150 + 10 * wave + first * left);
  }
  return run;
}

TEST(Periodicity, ChangesAreThoseOfTheSamePhase) {
  const double dt = T / 450;
  const auto found = periodicity_of(settling(16, dt, 6), T);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->beats.size(), 5U);
  for (const BeatChange& change : found->beats) {
    // the first step of beat k against the one before: 2 first (2^(2-k) - 2^(1-k)) 2^(-dt/T), over the mean of the beat
    const double k = static_cast<double>(change.beat), left = std::exp2(-(k - 1)), settled = left / (2 * std::log(2.0));
    EXPECT_NEAR(change.pressure, 32 * left * std::exp2(-dt / T) / (100 + 32 * settled), 2e-5) << k;
    EXPECT_NEAR(change.volume, 16 * left * std::exp2(-dt / T) / (150 + 16 * settled), 2e-5) << k;
  }
  EXPECT_FALSE(found->periodic_from);
  EXPECT_EQ(periodicity_of(settling(16, dt, 8), T)->periodic_from, 7);
}

/// Steps that do not divide the beat: the beat before is taken between its steps, with the square of the step.
TEST(Periodicity, DoesNotMindStepsThatDoNotDivideTheBeat) {
  const auto off = [](double dt) { return periodicity_of(settling(0, dt, 4), T)->beats.back().pressure; };
  EXPECT_LT(off(T / 450.5), 2e-5);
  EXPECT_NEAR(off(T / 100.5) / off(T / 200.5), 4, 0.2);
  EXPECT_EQ(periodicity_of(settling(0, T / 300.5, 4), T)->periodic_from, 2);
}

TEST(Periodicity, WantsTwoBeatsAndPositivePressures) {
  EXPECT_FALSE(periodicity_of(settling(1, T / 100, 1), T));
  BeatingRun run = settling(1, T / 100, 3);
  for (double& p : run.pressures[0]) p -= 150;
  EXPECT_FALSE(periodicity_of(run, T));
}

/// From the files of a run, in the case's units.
TEST(Periodicity, OfARunsTable) {
  const TemporaryFolder folder;
  const auto wanted = settling(16, T / 90, 4);
  std::ofstream table(folder / "timeseries.csv");
  table << "time [s],fluid.in.pressure [g/(cm s2)],fluid.volume [cm3],fluid.in.pressure [mmHg]\n";
  for (std::size_t i = 0; i < wanted.times.size(); ++i)
    table << wanted.times[i] << "," << wanted.pressures[0][i] - 70 << "," << wanted.volumes[i] << ",0\n";
  table.close();
  std::ofstream(folder / "q.csv") << "time, value\n0,1\n";
  const auto of = [&](const std::string& flow) {
    std::ofstream(folder / "case.yaml") << "name: a\nfluid: {inlets: {in: {flow: " << flow << "}}}\n";
    return periodicity_of(folder / "timeseries.csv", folder / "case.yaml", 0, 70, UnitSystem::cgs());
  };
  const auto found = of("{file: q.csv, period: 900 ms}");
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->period, T, 1e-12);
  EXPECT_NEAR(found->beats.at(1).pressure, periodicity_of(wanted, T)->beats.at(1).pressure, 1e-4);
  EXPECT_FALSE(of("{constant: 80}"));
  EXPECT_FALSE(of("{file: q.csv}"));
}

}  // namespace
}  // namespace tether
