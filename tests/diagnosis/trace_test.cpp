#include "diagnosis/comparison/trace_discrepancy.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tether {
namespace {

Trace trace(std::vector<double> times, std::vector<double> values, Noise noise, double period) {
  Curve curve(times, values, {.period = period});
  return {"cuff", "fluid.outlet.pressure", std::move(times), std::move(values), std::move(curve), noise, period};
}

/// A run of two periods whose value is its time within the period.
RunTrace saw() {
  RunTrace run{{}, {}, "cm"};
  for (int i = 0; i <= 200; ++i) {
    run.times.push_back(0.01 * i);
    run.values.push_back(std::fmod(0.01 * i, 1.0));
  }
  return run;
}

TEST(Trace, IsComparedAtItsOwnTimesInTheLastPeriod) {
  const TraceDiscrepancy found = compare(trace({0.1, 0.25, 0.4}, {0.4, 0.55, 0.1}, {0.1, 0, 0.05}, 1), saw());
  ASSERT_EQ(found.times.size(), 3U);
  EXPECT_NEAR(found.times[0], 1.1, 1e-12);
  EXPECT_NEAR(found.model[1], 0.25, 1e-12);
  EXPECT_NEAR(found.bias, 0.1, 1e-12);
  EXPECT_NEAR(found.largest, 0.3, 1e-12);
  EXPECT_NEAR(found.rms, 0.3, 1e-12);
  EXPECT_NEAR(found.effective, 3, 1e-12) << "0.3 s of errors alike over 0.05 s, as many as values";
  EXPECT_NEAR(*found.z(), std::sqrt(3.0), 1e-12);
  EXPECT_EQ(sentence_of(found, UnitSystem::cgs()),
            "cuff: fluid.outlet.pressure is 1 mm too low on average (1.7 sigma), 3 off in root mean square");
}

TEST(Trace, CountsValuesThatTheRunDoesNotReach) {
  const TraceDiscrepancy found = compare(trace({0.5, 1.5, 2.5}, {0.2, 0.5, 1}, {}, 0), saw());
  EXPECT_EQ(found.outside, 1);
  EXPECT_FALSE(found.z());
  EXPECT_EQ(sentence_of(found, UnitSystem::cgs()),
            "cuff: fluid.outlet.pressure is 1.5 mm too high on average, 2.12 off in root mean square");
}

/// Pascal that are called mmHg, a pressure from another zero.
TEST(Trace, DoubtsWhatNoModelIsOffBy) {
  const auto said = [](double factor, double offset) {
    const auto value = [&](double t) { return factor * t + offset; };
    return sentence_of(compare(trace({0.1, 0.4, 0.9}, {value(0.1), value(0.4), value(0.9)}, {0.1}, 1), saw()),
                       UnitSystem::cgs());
  };
  EXPECT_NE(said(133.3, 0).find("swings 133 times as far as the model: is its unit right?"), std::string::npos);
  EXPECT_NE(said(0.1333, 0).find("swings 0.133 times"), std::string::npos);
  EXPECT_NE(said(1, 3).find("same zero"), std::string::npos);
  EXPECT_EQ(said(1.5, 0.5).find('?'), std::string::npos);
}

}  // namespace
}  // namespace tether
