/// Published quantities of runs whose answers are known.
#include "diagnosis/comparison/beat_quantities.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace tether {
namespace beat_quantities_test {

constexpr double mmhg = 1333.22;  // g/(cm s2)

/// Two beats of a lumen whose volume follows the pressure: the first one is of twice the size.
FinishedMotion beats() {
  FinishedMotion run;
  run.trace = [](const std::string& column) {
    RunTrace trace;
    for (int i = 0; i <= 200; ++i) {
      const double t = 0.01 * i, beat = 0.5 * (1 - std::cos(2 * std::numbers::pi * t)) * (t < 1 ? 2 : 1);
      trace.times.push_back(t);
      trace.values.push_back(column == "fluid.volume"           ? 10 * (1 + 0.1 * beat)
                             : column == "fluid.heart.pressure" ? 40 * mmhg * beat
                             : column == "fluid.left.flow"      ? 30 * beat
                                                                : 10 * beat);
    }
    return trace;
  };
  return run;
}

BeatFacts facts() {
  BeatFacts facts{UnitSystem::cgs(),
                  {"fluid.heart.pressure", "fluid.volume", "fluid.left.flow", "fluid.right.flow"},
                  {"heart"},
                  {"left", "right"}};
  facts.imaged = 80 * mmhg;
  facts.density = 1.06;
  facts.period = 1;
  return facts;
}

double value(const std::vector<QuantityFound>& all, Quantity quantity, const std::string& where = "") {
  for (const QuantityFound& one : all)
    if (one.quantity == quantity && one.where == where) return one.value;
  return undefined;
}

TEST(BeatQuantities, AreThoseOfTheLastBeat) {
  const auto all = beat_quantities(beats(), facts());
  EXPECT_NEAR(value(all, Quantity::systolic_pressure, "heart"), 120, 1e-3);
  EXPECT_NEAR(value(all, Quantity::diastolic_pressure, "heart"), 80, 1e-3);
  EXPECT_NEAR(value(all, Quantity::strain), 10, 1e-9);
  EXPECT_NEAR(value(all, Quantity::distensibility), 2.5, 1e-3);  // 10 % in 40 mmHg
  const double c = std::sqrt(40 * mmhg / (1.06 * 0.1)) / 100;    // (D.22)
  EXPECT_NEAR(value(all, Quantity::pulse_wave_velocity), c, 1e-3 * c);
  EXPECT_NEAR(value(all, Quantity::peak_flow, "left"), 30, 1e-9);
  EXPECT_NEAR(value(all, Quantity::flow_share, "left"), 75, 1e-9);
  EXPECT_NEAR(value(all, Quantity::flow_share, "right"), 25, 1e-9);
}

TEST(BeatQuantities, StressesOfTheWall) {
  BeatFacts all = facts();
  all.columns.insert(all.columns.end(), {"solid.peak_stress", "fluid.wall_shear"});
  const auto found = beat_quantities(beats(), all);
  EXPECT_NEAR(value(found, Quantity::peak_wall_stress), 10 * 0.1 / 1e3, 1e-12) << "g/(cm s2) in kPa";
  EXPECT_NEAR(value(found, Quantity::wall_shear), 5 * 0.1, 1e-6) << "the mean of 10 (1 - cos)/2, in Pa";
}

TEST(BeatQuantities, OfTheWholeRunWhereNoPeriodIsKnown) {
  BeatFacts whole = facts();
  whole.period = 0;
  EXPECT_NEAR(value(beat_quantities(beats(), whole), Quantity::strain), 20, 1e-9);
}

TEST(BeatQuantities, AreThoseThatTheColumnsAllow) {
  BeatFacts some = facts();
  some.columns = {"fluid.heart.pressure", "fluid.left.flow"};
  some.outlets = {"left"};
  const auto all = beat_quantities(beats(), some);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(name_of(all[0]), "systolic pressure at heart [mmHg]");
  EXPECT_TRUE(std::isnan(value(all, Quantity::strain)));
  EXPECT_TRUE(std::isnan(value(all, Quantity::flow_share, "left"))) << "all that leaves";
}

TEST(BeatQuantities, AreToldWithTheirInterval) {
  QuantityFound quantity{Quantity::strain, "", 12.345, 11.8, 13.02, "%"};
  EXPECT_EQ(value_text(quantity), "12.35 (11.8 .. 13.02)");
  quantity.lower.reset();
  EXPECT_EQ(value_text(quantity), "12.35");
}

}  // namespace beat_quantities_test
}  // namespace tether
