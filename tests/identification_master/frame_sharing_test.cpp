#include "identification_master/frame_sharing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tether {
namespace frame_sharing_test {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr StepEnds ends{.start = 0, .dt = 0.01, .length = 0.8};
constexpr int steps = 80;

/// How often frames count in a run, and in how many steps of their own they are seen.
struct Counted {
  double shared = 0;
  int own = 0;
};
Counted counted(const FrameSharing& frames, int number = steps, double dt = ends.dt) {
  Counted all;
  for (int step = 1; step <= number; ++step) {
    const SeenFrame seen = frames.at(step * dt);
    all.shared += seen.share;
    all.own += seen.is_own ? 1 : 0;
  }
  return all;
}

void expect_each_once(const FrameSharing& frames, int count) {
  const Counted all = counted(frames);
  EXPECT_NEAR(all.shared, count, 1e-9);
  EXPECT_EQ(all.own, count);
}

TEST(FrameSharing, EachFrameOfASeriesCountsOnce) {
  const double half = ends.dt / 2;
  expect_each_once({{0.08, 0.16, 0.24, 0.40, 0.72}, 0, half, ends}, 5);
  expect_each_once({{0.083, 0.167, 0.241, 0.797}, 0, half, ends}, 4);  // between the ends of steps
}

TEST(FrameSharing, RepeatsWithItsPeriod) {
  std::vector<double> times;
  for (int k = 0; k < 10; ++k) times.push_back(0.08 * k);
  expect_each_once({times, 0.8, ends.dt / 2, ends}, 10);
  times.push_back(0.8);
  expect_each_once({times, 0.8, ends.dt / 2, ends}, 10);
  expect_each_once({{0.03, 0.11, 0.17}, 0.2, ends.dt / 2, ends}, 12);
  expect_each_once({{-0.5}, 0.4, ends.dt / 2, ends}, 2);
}

TEST(FrameSharing, ASingleFrameCountsOnceToo) {
  for (const double time : {0.4, 0.403, 0.405, 0.4 - 1e-13}) expect_each_once({{time}, 0, ends.dt / 2, ends}, 1);
  const Counted always = counted({{nan}, 0, 0, ends});
  EXPECT_NEAR(always.shared, 1, 1e-12);
  EXPECT_EQ(always.own, steps);
}

TEST(FrameSharing, AFirstFrameAtTheStartAndALastAtAnyTimeAreNotLost) {
  EXPECT_NEAR(counted({{0, 0.08, 0.16}, 0, ends.dt / 2, ends}).shared, 3, 1e-9);
  EXPECT_NEAR(counted({{0, 0.08, 0.16}, 0, 0, ends}).shared, 3, 1e-9);
  for (const double last : {0.2, 0.202, 0.205, 0.208})
    EXPECT_EQ(counted({{0.1, last}, 0, ends.dt / 2, ends}).own, 2) << last;
}

TEST(FrameSharing, TheStepMakesNoDifference) {
  for (const double dt : {0.02, 0.01, 0.0025}) {
    const FrameSharing frames({0, 0.1, 0.2, 0.5, 0.8}, 0, dt / 2, {0, dt, 0.8});
    EXPECT_NEAR(counted(frames, static_cast<int>(std::lround(0.8 / dt)), dt).shared, 5, 1e-9) << dt;
  }
}

/// Of values denser than steps only those that a step sees count, and they are a step apart.
TEST(FrameSharing, ValuesDenserThanStepsCountOnceAStep) {
  std::vector<double> times;
  for (int k = 1; k <= 800; ++k) times.push_back(1e-3 * k);
  const FrameSharing frames(times, 0, ends.dt / 2, ends);
  expect_each_once(frames, steps);
  EXPECT_DOUBLE_EQ(frames.at(0.4).apart, ends.dt);
  EXPECT_DOUBLE_EQ(FrameSharing({0.1, 0.3, 0.6}, 0, 0, ends).at(0.3).apart, 0.25);
}

TEST(FrameSharing, NothingIsSeenOutsideAndOfNothing) {
  const FrameSharing frames({0.2, 0.4}, 0, ends.dt / 2, ends);
  for (const double time : {0.1, 0.18, 0.42, 0.8}) {
    EXPECT_EQ(frames.at(time).share, 0) << time;
    EXPECT_FALSE(frames.at(time).is_own);
  }
  EXPECT_EQ(counted({{}, 0.8, 0.1, ends}).shared, 0);
}

/// Between two frames their errors are averaged, unless they last: by the parabola and by chords.
TEST(FrameSharing, ErrorsOfWhatIsMadeBetweenFramesAreSmaller) {
  const std::vector<double> times{0.2, 0.4};
  EXPECT_NEAR(FrameSharing(times, 0, 0, ends).at(0.25).error_square, 0.75 * 0.75 + 0.25 * 0.25, 1e-12);
  EXPECT_NEAR(FrameSharing(times, 0, 0, ends, 1e9).at(0.25).error_square, 1, 1e-6);
  const FrameSharing cubic({0.1, 0.2, 0.4, 0.5}, 0, 0, ends),
      chord({0.1, 0.2, 0.4, 0.5}, 0, 0, ends, 0, FrameCurve::chord);
  EXPECT_NEAR(cubic.at(0.3).error_square, 2 * (16.0 / 36 + 1.0 / 36), 1e-12);
  EXPECT_NEAR(chord.at(0.3).error_square, 0.5, 1e-12);
}

/// Each frame keeps its place among four as long as data have a part of it.
TEST(FrameSharing, PartsStayInTheirPlaces) {
  const FrameSharing frames({0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, 0, 0, ends);
  for (double time = 0.105; time < 0.6; time += 0.01) {
    double sum = 0;
    const auto parts = frames.parts_at(time);
    for (std::int64_t place = 0; place < 4; ++place) {
      const FramePart& part = parts[static_cast<std::size_t>(place)];
      EXPECT_EQ(((part.frame - place) % 4 + 4) % 4, 0) << time;
      sum += part.part;
    }
    EXPECT_NEAR(sum, 1, 1e-12) << time;
  }
  const auto middle = frames.parts_at(0.35);  // of 0.2, 0.3, 0.4, 0.5: numbers 1, 2, 3, 4
  EXPECT_NEAR(middle[1].part, -1.0 / 16, 1e-12);
  EXPECT_NEAR(middle[2].part, 9.0 / 16, 1e-12);
  EXPECT_NEAR(middle[3].part, 9.0 / 16, 1e-12);
  EXPECT_NEAR(middle[0].part, -1.0 / 16, 1e-12);
}

}  // namespace frame_sharing_test
}  // namespace tether
