/// Data of a tube that beats with the period 1: radius 12 (1 + 0.1 (1 - cos 2 pi t)), length 40. Lengths in mm.
#include "twin/twin_data.hpp"

#include <gtest/gtest.h>

#include "common/base/error.hpp"
#include "common/config/case_file.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/twin/shapes.hpp"

namespace tether {
namespace {

using namespace testing;

double radius_at(double time) {
  return 12 * (1 + 0.1 * (1 - std::cos(2 * std::numbers::pi * time)));
}

TrueLumen beating() {
  return {tube(12, 40, 48, 16).triangles, [](double time) { return tube(radius_at(time), 40, 48, 16).points; }, 0, 2};
}

/// Ten frames a beat without noise or voxels.
TwinCase plain() {
  TwinCase given;
  given.beat = 1;
  given.image.voxel = {0, 0, 0};
  return given;
}

TwinCase with_voxels() {
  TwinCase given = plain();
  given.image.voxel = {};
  given.frames = 2;
  return given;
}

/// As a case says it.
TwinCase twin_of(const std::string& text) {
  const TemporaryFolder folder;
  CaseFile file(folder.file("case.yaml",
                            "name: tube\nunits: mm-g-s\ntime: {step: 1e-2, end: 2}\ntwin: {truth: case.yaml, hidden: "
                            "{verdict: nothing_missing}, " +
                                text + "}\n"));
  TwinCase given;
  file.read("twin", given);
  file.finish();
  return given;
}

Faults faults_of(const std::string& text) {
  return twin_of("faults: {" + text + "}").faults;
}

TwinFrames made(const TwinCase& given) {
  return make_frames(given, UnitSystem::named("mm-g-s"), beating(), "case.yaml:9: twin");
}

std::string error_of(const TwinCase& given) {
  try {
    made(given);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

double radius_of(const TriangleSurface& surface) {
  return surface.points.topRows(2).colwise().norm().mean();
}

TEST(TwinFrames, ShowTheTruthAtTheStatedTimes) {
  const TwinFrames frames = made(plain());
  ASSERT_EQ(frames.frames.size(), 10U);
  for (int i = 0; i < 10; ++i) {
    const TwinFrame& frame = frames.frames[static_cast<std::size_t>(i)];
    EXPECT_NEAR(frame.time, 1.1 + 0.1 * i, 1e-12) << "the last is at the end";
    EXPECT_NEAR(radius_of(frame.surface), radius_at(frame.time), 1e-3);
  }
  EXPECT_EQ(frames.image_error, 0);
  TwinCase given = plain();
  given.first = 0.5;
  EXPECT_NEAR(times_of_frames(given, beating()).back(), 1.4, 1e-12);
  given.beat.reset();
  given.first.reset();
  EXPECT_NEAR(times_of_frames(given, beating()).front(), 0.2, 1e-12) << "without a beat, over the whole run";
}

TEST(TwinFrames, OfVoxelsAreUnbiasedWithinATenthOfAVoxel) {
  const TwinFrames frames = made(with_voxels());
  for (const TwinFrame& frame : frames.frames) {
    EXPECT_NEAR(radius_of(frame.surface), radius_at(frame.time), 0.06);
    EXPECT_GT(frame.surface.points.row(2).maxCoeff(), 19);
    EXPECT_LT(frame.surface.points.row(2).maxCoeff(), 20.5) << "open, without what was drawn out";
  }
  EXPECT_GT(frames.image_error, 0.01);
  EXPECT_LT(frames.image_error, 0.2);
}

TEST(TwinFrames, AreTheSameForTheSameSeed) {
  TwinCase given = with_voxels();
  given.noise.deviation = 0.3;
  given.noise.correlation_length = 5;
  const TwinFrames one = made(given), again = made(given);
  given.seed = 2;
  const TwinFrames other = made(given);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(one.frames[i].surface.points == again.frames[i].surface.points);
    EXPECT_TRUE(one.frames[i].surface.triangles == again.frames[i].surface.triangles);
    EXPECT_FALSE(one.frames[i].surface.points.cols() == other.frames[i].surface.points.cols() &&
                 one.frames[i].surface.points == other.frames[i].surface.points);
  }
}

/// Errors of the radius: their size, half the mean square of the difference of neighbours less than 0.8 mm apart, and
/// the mean product of those about 5 mm apart.
TEST(TwinFrames, HaveNoiseOfTheStatedSizeAndReach) {
  TwinCase given = plain();
  given.frames = 1;
  given.noise.deviation = 0.3;
  given.noise.correlation_length = 5;
  std::vector<double> all, near, expected, far;
  for (given.seed = 0; given.seed < 30; ++given.seed) {
    TwinCase exact = given;
    exact.noise.deviation = 0;
    const Points x = made(exact).frames[0].surface.points, moved = made(given).frames[0].surface.points;
    const VectorXd error = (moved.topRows(2).colwise().norm() - x.topRows(2).colwise().norm()).transpose();
    for (Eigen::Index i = 0; i < x.cols(); i += 97)
      for (Eigen::Index j = 0; j < x.cols(); ++j) {
        const double apart = (x.col(i) - x.col(j)).norm();
        if (i == j) all.push_back(error[i] * error[i]);
        if (i != j && apart < 0.8) near.push_back(std::pow(error[i] - error[j], 2) / 2);
        if (i != j && apart < 0.8) expected.push_back(0.09 * (1 - std::exp(-apart / 5)));
        if (apart > 4.8 && apart < 5.2) far.push_back(error[i] * error[j]);
      }
  }
  const auto mean = [](const std::vector<double>& v) {
    return VectorXd::Map(v.data(), static_cast<Eigen::Index>(v.size())).mean();
  };
  EXPECT_NEAR(std::sqrt(mean(all)), 0.3, 0.02);
  EXPECT_NEAR(mean(near) / mean(expected), 1, 0.1);
  EXPECT_NEAR(mean(far) / 0.09, std::exp(-1.0), 0.08);
}

TEST(TwinFaults, DoWhatTheySay) {
  const TwinFrames right = made(plain());
  TwinCase given = plain();
  given.faults = faults_of(
      "lost: [3, 7], mistimed: {frame: 2, shift: 0.05}, misplaced: {frame: 4, offset: [1, 2, 3]}, "
      "cropped: {frame: 5, point: [0, 0, 10], normal: [0, 0, 2]}");
  const TwinFrames wrong = made(given);
  ASSERT_EQ(wrong.frames.size(), 8U);
  std::vector<int> numbers;
  for (const TwinFrame& frame : wrong.frames) {
    numbers.push_back(frame.number);
    const TwinFrame& as_it_was = right.frames[static_cast<std::size_t>(frame.number)];
    EXPECT_EQ(frame.time, as_it_was.time) << "what is wrong is not stated";
    const Points &x = frame.surface.points, &before = as_it_was.surface.points;
    if (frame.number == 2)
      EXPECT_NEAR(radius_of(frame.surface), radius_at(1.35), 1e-3);
    else if (frame.number == 4)
      EXPECT_LT((x - before - Vec3(1, 2, 3).replicate(1, x.cols())).cwiseAbs().maxCoeff(), 1e-12);
    else if (frame.number == 5)
      EXPECT_TRUE(x.row(2).maxCoeff() <= 10 && x.row(2).maxCoeff() > 8 && x.cols() > before.cols() / 2);
    else
      EXPECT_TRUE(x == before) << frame.number;
  }
  EXPECT_EQ(numbers, (std::vector{0, 1, 2, 4, 5, 6, 8, 9}));
}

TEST(TwinFaults, ConcernAllFramesUnlessOneIsNamed) {
  const TwinFrames right = made(plain());
  TwinCase given = plain();
  given.first = 1;
  given.faults = faults_of("mistimed: {shift: 0.1}, bias: 0.5, clipped_ends: 6");
  for (const TwinFrame& frame : made(given).frames) {
    EXPECT_NEAR(radius_of(frame.surface), radius_at(frame.time + 0.1) + 0.5, 2e-3);
    EXPECT_LT(frame.surface.points.row(2).cwiseAbs().maxCoeff(), 20 - std::sqrt(6 * 6 - 0.5 * 0.5) + 1e-3);
    EXPECT_GT(frame.surface.points.row(2).cwiseAbs().maxCoeff(), 12);
  }
}

TEST(TwinFaults, OfFramesThatDoNotExistAreTold) {
  TwinCase given = plain();
  given.faults = faults_of("misplaced: {frame: 10, offset: [1, 0, 0]}");
  EXPECT_EQ(error_of(given), "case.yaml:9: twin.faults: frame 10 of 10, counted from 0");
  given = plain();
  given.faults = faults_of("mistimed: {frame: 9, shift: 0.2}");
  EXPECT_EQ(error_of(given), "case.yaml:9: twin: frame 9 shows the time 2.2, but the truth's run is from 0 to 2");
  given = plain();
  given.faults = faults_of("lost: [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]");
  EXPECT_EQ(error_of(given), "case.yaml:9: twin.faults.lost: no frame is left");
}

TEST(TwinTrace, IsTheRunsValuesWithNoise) {
  std::vector<double> times, values;
  for (int i = 0; i <= 200; ++i) times.push_back(0.01 * i), values.push_back(5.0 * i);
  TwinTraceCase given;
  given.interval = 0.025;
  const TwinTrace exact = make_trace(given, times, values, 1, 3);
  ASSERT_EQ(exact.times.size(), 41U);
  for (std::size_t i = 0; i < exact.times.size(); ++i) EXPECT_NEAR(exact.values[i], 500 * exact.times[i], 1e-9);
  given.noise.deviation = 2;
  given.interval = 1e-4;
  const TwinTrace noisy = make_trace(given, times, values, 0, 3);
  double squares = 0;
  for (std::size_t i = 0; i < noisy.times.size(); ++i) squares += std::pow(noisy.values[i] - 500 * noisy.times[i], 2);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(noisy.times.size())), 2, 0.05);
}

TEST(TwinTrace, IsOffAllOverAsItsFaultsSay) {
  std::vector<double> times, values;
  for (int i = 0; i <= 200; ++i) times.push_back(0.01 * i), values.push_back(5.0 * i);
  const TwinCase given = twin_of(
      "traces: {p: {observable: fluid.outlet.pressure, quantity: pressure, interval: 25 ms, faults: {factor: 2, "
      "offset: 7, delay: 40 ms}}}");
  const TwinTrace late = make_trace(given.traces.front().second, times, values, 1, 3);
  ASSERT_EQ(late.times.size(), 41U);
  const double by_factor_first = 2 * 500 * (1 - 0.04) + 7;
  EXPECT_NEAR(late.values.front(), by_factor_first, 1e-9);
  for (std::size_t i = 0; i < late.times.size(); ++i)
    EXPECT_NEAR(late.values[i] - late.values.front(), 1000 * (late.times[i] - late.times.front()), 1e-9);
}

/// What check_scales says of a twin; "accepted" if nothing.
std::string scale_refusal(const TwinCase& given) {
  try {
    check_scales(given, UnitSystem::named("mm-g-s"), beating(), 1,
                 [](const std::string& field) { return "case.yaml:9: " + field; });
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(TwinScales, ThatCannotBeMadeAreRefusedWithTheirField) {
  EXPECT_EQ(scale_refusal(plain()), "accepted");
  EXPECT_EQ(scale_refusal(with_voxels()), "accepted");
  TwinCase given = plain();
  const auto expect = [&](const std::string& part) {
    EXPECT_NE(scale_refusal(given).find(part), std::string::npos) << scale_refusal(given);
  };
  for (const double voxel : {1e-4, 1e-300}) {
    given.image.voxel = {voxel, voxel, voxel};
    expect("case.yaml:9: twin.image.voxel: would make ");
    expect(" voxels: must make at most 5e+07");
  }
  given.image.voxel = {1e300, 1, 1};
  expect("case.yaml:9: twin.image.voxel: 1e+300: must not be larger than the vessel, which is 40 long");
  given.image.voxel = {1, 1, 1};
  given.image.blur = 1e300;
  expect("case.yaml:9: twin.image.blur: 1e+300: must not be larger than the vessel");
  given = plain();
  given.noise.deviation = 1e10;
  expect("case.yaml:9: twin.noise.deviation: 1e+10: must not be larger than the vessel");
  given = plain();
  given.traces.emplace_back("a", TwinTraceCase{}).second.interval = 1e-300;
  expect("case.yaml:9: twin.traces.a.interval: would make 1e+300 values: must make at most 1e+06");
}

TEST(TwinFrames, OfAnImageThatShowsNothingAreRefused) {
  TwinCase given = with_voxels();
  given.image.voxel = {38, 38, 38};
  EXPECT_EQ(error_of(given),
            "case.yaml:9: twin.image: nothing of the vessel is seen: its voxels or its blur are too large");
  given.image.voxel = {1, 1, 1};
  given.image.blur = 30;
  EXPECT_EQ(error_of(given),
            "case.yaml:9: twin.image: nothing of the vessel is seen: its voxels or its blur are too large");
}

/// What reading a section `twin` says.
std::string reading(const std::string& text) {
  const TemporaryFolder folder;
  try {
    CaseFile file(folder.file("case.yaml",
                              "name: tube\nunits: mm-g-s\ntime: {step: 1e-2, end: 2}\ntwin:\n  truth: case.yaml\n  "
                              "hidden: {verdict: nothing_missing}\n  frames: 4\n  faults: {lost: [1]}\n  " +
                                  text + "\n"));
    TwinCase given;
    file.read("twin", given);
    file.finish();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(TwinCase, HoldsOutFramesThatItHas) {
  EXPECT_EQ(reading("held_out: [0, 2]"), "accepted");
  for (const char* wrong : {"held_out: [99999]", "held_out: [3]", "held_out: [0.5]"})
    EXPECT_NE(reading(wrong).find("case.yaml:9: twin.held_out: must be whole numbers, from 0 to 2"), std::string::npos)
        << reading(wrong);
}

TEST(TwinCase, NoiseIsOfAScale) {
  EXPECT_EQ(reading("noise: {deviation: 0.3, correlation_length: 5}"), "accepted");
  EXPECT_NE(
      reading("noise: {deviation: 1e15}").find("case.yaml:9: twin.noise.deviation: 1e15: must not be larger than 1e12"),
      std::string::npos);
  for (const char* field : {"correlation_length", "correlation_time"})
    for (const char* value : {"1e-20", "1e15"}) {
      const std::string told = reading(fmt::format("noise: {{deviation: 1, {}: {}}}", field, value));
      EXPECT_NE(told.find(fmt::format("case.yaml:9: twin.noise.{}: {}: must be 0, or at least", field, value)),
                std::string::npos)
          << told;
    }
}

}  // namespace
}  // namespace tether
