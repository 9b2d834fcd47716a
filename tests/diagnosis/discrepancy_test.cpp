#include "diagnosis/comparison/discrepancy.hpp"

#include <gtest/gtest.h>

#include "tests/diagnosis/beating_tube.hpp"

namespace tether::testing {
namespace discrepancy_test {

const std::vector<std::string> regions{"right", "left"};

TEST(Discrepancy, OfARunWithItselfIsZeroAndTheApparentMotionIsNot) {
  const SourceDiscrepancy found = compare(beating_surfaces(), regions, beating_run(1));
  ASSERT_EQ(found.moments.size(), 8U);
  for (const Moment& moment : found.moments) {
    ASSERT_EQ(moment.groups.size(), 3U) << "all, right, left";
    const Group& all = *group_of_region(moment, -1);
    EXPECT_LT(all.model.largest, 1e-12);
    EXPECT_GT(all.model.used(), 1000);
    EXPECT_NEAR(all.apparent.mean, growth(moment.time), sag) << "the imaged lumen lies inside by the growth";
    EXPECT_EQ(group_of_region(moment, 0)->model.used() + group_of_region(moment, 1)->model.used(), all.model.used());
  }
}

TEST(Discrepancy, OfAShiftedRunIsTheShift) {
  const Vec3 shift(0.05, 0, 0);
  const SourceDiscrepancy found = compare(beating_contours({}, {0, 0}), regions, beating_run(1, shift));
  EXPECT_EQ(found.series, (std::vector<std::string>{"slice low", "slice high"}));
  EXPECT_EQ(found.dimension, 1);
  for (const Moment& moment : found.moments) {
    EXPECT_EQ(moment.frames.size(), 2U) << "slices of one time are one moment";
    EXPECT_EQ(moment.groups.size(), 9U) << "two slices and both together, two regions and both together";
    // The signed distance of a circle moved by s along x is -s cos(angle): over x > 0 its mean is -2 s/pi.
    for (const auto& [region, sign] : {std::pair{0, -1.0}, {1, 1.0}}) {
      const Statistics& s = group_of_region(moment, region)->model;
      EXPECT_NEAR(s.mean, sign * 2 * 0.05 / std::numbers::pi, sag);
      EXPECT_NEAR(s.rms, 0.05 / std::numbers::sqrt2, sag);
      EXPECT_NEAR(s.largest, 0.05, sag);
      EXPECT_NEAR(s.unnormalised, s.rms * std::sqrt(s.extent), 1e-12);
    }
    EXPECT_NEAR(group_of_region(moment, -1)->model.mean, 0, sag);
  }
}

/// What two regions have together one part of both has; a region of no part counts for the whole only.
TEST(Discrepancy, IsToldForPartsOfSeveralRegions) {
  const RunMotion run = beating_run(1, {0.05, 0, 0});
  ErrorRegions both, right_only;
  both.names = {"both"}, both.parts = {0, 0};
  right_only.names = {"right half"}, right_only.parts = {0, -1};
  const SourceDiscrepancy apart = compare(beating_surfaces(), regions, run),
                          together = compare(beating_surfaces(), both, run),
                          alone = compare(beating_surfaces(), right_only, run);
  EXPECT_EQ(together.regions, std::vector<std::string>{"both"});
  for (std::size_t m = 0; m < apart.moments.size(); ++m) {
    const Moment &each = apart.moments[m], &one = together.moments[m], &half = alone.moments[m];
    ASSERT_EQ(one.groups.size(), 2U);
    EXPECT_EQ(group_of_region(one, 0)->model.rms, group_of_region(each, -1)->model.rms);
    EXPECT_EQ(group_of_region(half, 0)->model.rms, group_of_region(each, 0)->model.rms);
    EXPECT_EQ(group_of_region(half, -1)->model.rms, group_of_region(each, -1)->model.rms);
  }
}

TEST(Discrepancy, TakesTheLastPeriodOfARun) {
  RunMotion run = beating_run(3.3);
  std::vector<double> asked;
  run.positions = [&asked](double time) {
    asked.push_back(time);
    return tube_at(time).points;
  };
  const SourceDiscrepancy found = compare(beating_surfaces(), regions, run);
  EXPECT_EQ(asked, (std::vector<double>{2.375, 2.5, 2.625, 2.75, 2.875, 3, 3.125, 3.25}));
  for (const Moment& moment : found.moments) EXPECT_LT(group_of_region(moment, -1)->model.largest, 1e-12);
}

TEST(Discrepancy, CountsFramesThatTheRunDoesNotReach) {
  const SourceDiscrepancy found = compare(beating_surfaces({}, 0), regions, beating_run(0.5));
  EXPECT_EQ(found.moments.size(), 5U);
  ASSERT_EQ(found.outside.size(), 3U);
  EXPECT_EQ(found.outside[0].number, 5U);
  EXPECT_EQ(found.outside[2].number, 7U);
}

TEST(Discrepancy, KeepsHeldOutFramesApart) {
  RunMotion run = beating_run(1);
  run.positions = [](double time) {  // wrong in the held-out frames only
    return tube_at(time == 0.25 || time == 0.625 ? 0.5 : time).points;
  };
  const SourceDiscrepancy found = compare(beating_surfaces(), regions, run);
  EXPECT_LT(found.training[0].model.largest, 1e-12);
  EXPECT_GT(found.held_out[0].model.rms, 0.02);
  EXPECT_EQ(found.held_out[0].model.counts[0] * 3, found.training[0].model.counts[0]);
  EXPECT_EQ(std::count_if(found.moments.begin(), found.moments.end(), [](const Moment& m) { return m.held_out; }), 2);
}

/// Six of eight frames, from 0 to 0.875, are training data; errors are alike for 0.125: 3.5 frames.
TEST(Discrepancy, CountsFramesWithinACorrelationTimeOnce) {
  const SourceDiscrepancy without = compare(beating_surfaces({0.02, 0.25, 0}), regions, beating_run(1)),
                          with = compare(beating_surfaces({0.02, 0.25, 0.125}), regions, beating_run(1));
  EXPECT_EQ(without.training[0].effective, 0);
  double sum = 0;
  int count = 0;
  for (const Moment& moment : with.moments)
    if (!moment.held_out) sum += moment.groups[0].effective, ++count;
  ASSERT_EQ(count, 6);
  const double covered = with.moments.back().time - with.moments.front().time;
  EXPECT_NEAR(with.training[0].effective, sum / 6 * covered / 0.25, 1e-9);
  EXPECT_LT(with.training[0].effective, sum);
}

TEST(Discrepancy, AddsUpTheEffectiveNumbersOfSlices) {
  const Noise noise{0.02, 0.25, 0};
  const SourceDiscrepancy found = compare(beating_contours(noise, {0, 0}), regions, beating_run(1));
  const Moment& moment = found.moments[0];
  double slices = 0;
  for (const Group& group : moment.groups)
    if (group.series >= 0 && group.region < 0) slices += group.effective;
  const Group& all = *group_of_region(moment, -1);
  EXPECT_DOUBLE_EQ(all.effective, slices);
  EXPECT_NEAR(all.effective, all.model.extent / 0.5, 1e-12);
  EXPECT_NEAR(significance(all, noise), all.model.mean / 0.02 * std::sqrt(slices), 1e-12);
}

}  // namespace discrepancy_test
}  // namespace tether::testing
