#include "diagnosis/comparison/velocity_discrepancy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "observation_manager/measurements/independence.hpp"

namespace tether {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Three points on a line, measured at 0, 0.5 (held out) and 1 of a period of 1.5: along z everywhere `v`, but nothing
/// at the last point of the first frame.
VelocitySeries measured(double v, Noise noise) {
  const Points points{{0, 1, 3}, {0, 0, 0}, {5, 5, 5}};
  std::vector<VelocityFrame> frames;
  for (const double time : {0.0, 0.5, 1.0}) frames.push_back({time, time == 0.5, Components::Constant(1, 3, v)});
  frames[0].values(0, 2) = nan;
  return {{"pc_mr", Vec3::UnitZ().transpose(), 1.5, 0.01, noise}, points, frames};
}

/// A run from 0 to 2 with velocity 10 t along z, behind one point of another series; the first point leaves the lumen
/// at 1.4.
RunVelocity run() {
  return {0, 2,
          [](double time) {
            Points all = Points::Zero(3, 4);
            all.row(2).setConstant(10 * time);
            all.col(0).setConstant(1e3);
            if (time > 1.4) all.col(1).setConstant(nan);
            return all;
          },
          "cm/s"};
}

TEST(Velocity, IsComparedAtTheTimesAndPointsOfTheData) {
  const VelocityDiscrepancy found = compare(measured(30, {2, 0, 0}), run(), 1);
  ASSERT_EQ(found.moments.size(), 3U);
  EXPECT_EQ(found.moments[0].time, 1);
  EXPECT_EQ(found.moments[1].time, 1.5) << "in the last period that the run covers";
  EXPECT_EQ(found.moments[2].time, 2);
  EXPECT_NEAR(found.moments[0].found.rms, 20, 1e-12);
  EXPECT_EQ(found.moments[0].found.used, 3);
  EXPECT_NEAR(*found.z(found.moments[0]), 20 / 2 * std::sqrt(3), 1e-12);
  EXPECT_EQ(found.moments[1].missed, 1);
  EXPECT_EQ(found.moments[1].found.used, 1) << "one point was not measured, one is outside";
  EXPECT_NEAR(found.moments[1].found.bias, 15, 1e-12);
  EXPECT_TRUE(found.moments[2].held_out);
  EXPECT_NEAR(found.training.rms, std::sqrt((3 * 400 + 225) / 4.0), 1e-12);
  EXPECT_NEAR(found.training.measured, 30, 1e-12);
  EXPECT_NEAR(found.held_out.rms, 10, 1e-12);
  const std::vector<std::string> sentences = sentences_of(found, UnitSystem::cgs());
  ASSERT_EQ(sentences.size(), 2U);
  EXPECT_EQ(
      sentences[0],
      "pc_mr: velocities are 0.189 m/s off in root mean square (measured: 0.3 m/s; 9.4 times the noise), worst at 1 "
      "s: 0.2 m/s");
  EXPECT_EQ(sentences[1],
            "pc_mr, held-out frames: velocities are 0.1 m/s off in root mean square (measured: 0.3 m/s; 5.0 times the "
            "noise), worst at 2 s: 0.1 m/s");
}

TEST(Velocity, HasNoSignificanceWithoutNoise) {
  const VelocityDiscrepancy found = compare(measured(30, {}), run(), 1);
  EXPECT_FALSE(found.z(found.moments[0]));
}

/// The variance of a mean of n errors with the correlations c_ij is that of one over n^2 / sum c_ij.
TEST(Velocity, CountsNeighboursOnce) {
  const Points line{{0, 1}, {0, 0}, {0, 0}};
  EXPECT_DOUBLE_EQ(effective_points(line, 0), 2);
  EXPECT_DOUBLE_EQ(effective_points(line, 0.5), 4 / (2 + 2 * std::exp(-2)));
  EXPECT_NEAR(effective_points(line, 1e9), 1, 1e-8);
  const Points raster = [] {
    Points x(3, 41 * 41);
    for (int i = 0; i < 41 * 41; ++i) x.col(i) = Vec3(i % 41, i / 41, 0) * 0.25;
    return x;
  }();
  EXPECT_NEAR(effective_points(raster, 0.5) / (100 / (2 * 3.14159 * 0.25)), 1, 0.25) << "(D.2) of a large area";
}

}  // namespace
}  // namespace tether
