// What data between frames have of each of them.
#include "observation_manager/measurements/frame_sequence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "observation_manager/measurements/frame_times.hpp"

namespace tether::testing {
namespace frame_sequence_test {

/// What data at a time make of the values that a function has at the frames.
double made(const FrameSequence& frames, double time, const std::function<double(double)>& of) {
  const Between around = frames.around(time);
  double sum = 0;
  for (std::size_t part = 0; part < around.parts.size(); ++part)
    if (around.parts[part] != 0) sum += around.parts[part] * of(frames.time_of(around.frame(part)));
  return sum;
}

double sum(const std::array<double, 4>& parts) {
  return std::accumulate(parts.begin(), parts.end(), 0.0);
}

TEST(FrameSequence, FollowsCubicsAndAtItsEndsParabolas) {
  const FrameSequence frames({0, 0.1, 0.22, 0.3, 0.41, 0.5}, 0, 0);
  const auto cubic = [](double t) { return 1 - t + 4 * t * t - 7 * t * t * t; };
  const auto parabola = [](double t) { return 2 + t - 3 * t * t; };
  for (const double time : {0.1, 0.13, 0.22, 0.25, 0.35, 0.41})
    EXPECT_NEAR(made(frames, time, cubic), cubic(time), 1e-14) << time;
  for (const double time : {0.0, 0.04, 0.45, 0.499, 0.5})
    EXPECT_NEAR(made(frames, time, parabola), parabola(time), 1e-14) << time;
  for (double time = -0.1; time < 0.6; time += 0.013) EXPECT_NEAR(sum(frames.around(time).parts), 1, 1e-14) << time;
}

TEST(FrameSequence, IsTheFrameOnAFrameAndBesideItsEnds) {
  const FrameSequence frames({0.1, 0.2, 0.3, 0.4}, 0, 1e-9);
  using Parts = std::array<double, 4>;
  EXPECT_EQ(frames.around(0.2).parts, (Parts{0, 1, 0, 0}));
  EXPECT_EQ(frames.around(0.2 - 1e-10).before, 1);
  EXPECT_EQ(frames.around(0.05).parts, (Parts{0, 0, 1, 0}));
  EXPECT_EQ(frames.around(0.05).before, -1);
  EXPECT_EQ(frames.around(0.45).parts, (Parts{0, 1, 0, 0}));
}

/// A beat of ten frames and of twice as many: the error falls with the fourth power of their distance, that of the
/// chord with the second.
TEST(FrameSequence, ErrsWithTheFourthPowerOfTheFramesDistance) {
  constexpr double beat = 0.8;
  const auto motion = [](double t) { return std::sin(2 * std::numbers::pi * t / beat); };
  const auto error = [&](int count, FrameCurve curve) {
    std::vector<double> times;
    for (int k = 0; k < count; ++k) times.push_back(0.03 + beat * k / count);
    const FrameSequence frames(times, beat, 0, curve);
    double largest = 0;
    for (double time = -beat; time < 3 * beat; time += beat / 997)
      largest = std::max(largest, std::abs(made(frames, time, motion) - motion(time)));
    return largest;
  };
  EXPECT_NEAR(std::log2(error(10, FrameCurve::cubic) / error(20, FrameCurve::cubic)), 4, 0.1);
  EXPECT_NEAR(std::log2(error(10, FrameCurve::chord) / error(20, FrameCurve::chord)), 2, 0.1);
  EXPECT_LT(error(10, FrameCurve::cubic), error(10, FrameCurve::chord) / 10);
}

/// Three frames that repeat would put the same one on either side; a neighbour next to a frame would count many times.
TEST(FrameSequence, GoesByTheChordOrTheParabolaWhereNeighboursDoNotServe) {
  const auto parts = [](const FrameSequence& frames, double time) { return frames.around(time).parts; };
  const FrameSequence three({0, 0.2, 0.5}, 0.8, 0);
  EXPECT_NEAR(parts(three, 0.1)[1], 0.5, 1e-15);
  EXPECT_NEAR(parts(three, 0.1)[2], 0.5, 1e-15);
  const FrameSequence twins({0, 0.01, 0.21, 0.41, 0.42}, 0, 0);
  for (const double part : parts(twins, 0.11)) EXPECT_LT(std::abs(part), 0.8);
  EXPECT_EQ(parts(twins, 0.11)[0], 0);
  EXPECT_NEAR(parts(twins, 0.11)[3], -0.125, 1e-14);
}

TEST(FrameSequence, RepeatsWithItsPeriod) {
  const FrameSequence frames({0.1, 0.3, 0.5, 0.7, 0.9}, 0.8, 0);  // the last is the first again
  EXPECT_EQ(frames.count(), 4);
  EXPECT_NEAR(frames.time_of(-1), -0.1, 1e-15);
  EXPECT_NEAR(frames.time_of(9), 0.3 + 1.6, 1e-15);
  EXPECT_EQ(frames.number_of(-5), 3U);
  for (const double time : {0.2, 0.75, 0.85})
    for (std::size_t part = 0; part < 4; ++part)
      EXPECT_NEAR(frames.around(time).parts[part], frames.around(time - 4 * 0.8).parts[part], 1e-12) << time;
}

TEST(FrameSequence, KnowsTheErrorOfWhatItMakes) {
  const FrameSequence frames({0, 0.1, 0.2, 0.3}, 0, 0), chords({0, 0.1, 0.2, 0.3}, 0, 0, FrameCurve::chord);
  const double between = 0.15;
  EXPECT_NEAR(frames.error_square(frames.around(between), 0), 164.0 / 256, 1e-14);
  EXPECT_NEAR(chords.error_square(chords.around(between), 0), 0.5, 1e-14);
  EXPECT_NEAR(frames.error_square(frames.around(0.1), 0.05), 1, 1e-14);
  EXPECT_NEAR(frames.error_square(frames.around(between), 1e6), 1, 1e-6) << "an error that stays";
  EXPECT_NEAR(chords.error_square(chords.around(between), 0.1), 0.5 + 0.5 * std::exp(-1.0), 1e-14);
}

TEST(FrameTimes, LeaveHeldOutFramesAside) {
  const FrameTimes times({0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, 0, 0, {false, false, false, true, false, false, false});
  const std::vector<FrameShare> shares = times.at(0.3);
  ASSERT_EQ(shares.size(), 4U);
  const std::array<std::size_t, 4> expected{1, 2, 4, 5};
  for (std::size_t i = 0; i < shares.size(); ++i) {
    EXPECT_EQ(shares[i].frame, expected[i]);
    EXPECT_NEAR(shares[i].of_curve, i == 0 || i == 3 ? -1.0 / 6 : 2.0 / 3, 1e-14);
    EXPECT_NEAR(shares[i].of_chord, i == 0 || i == 3 ? 0 : 0.5, 1e-14);
  }
  EXPECT_EQ(times.at(0.2).size(), 1U);
  EXPECT_TRUE(times.at(0.61).empty());
}

}  // namespace frame_sequence_test
}  // namespace tether::testing
