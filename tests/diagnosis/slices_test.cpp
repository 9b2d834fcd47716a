#include "diagnosis/comparison/slices.hpp"

#include <gtest/gtest.h>

#include "tests/diagnosis/beating_tube.hpp"

namespace tether::testing {
namespace slices_test {

const std::vector<std::string> regions{"right", "left"};

double mean_radius(const Lines& lines) {
  double sum = 0;
  Eigen::Index count = 0;
  for (const Points& line : lines) {
    sum += line.topRows(2).colwise().norm().sum();
    count += line.cols();
  }
  return sum / static_cast<double>(count);
}

TEST(Slices, OfContoursShowModelAndDataInTheirPlanes) {
  const ContourSeries data = beating_contours({}, {0, 0});
  const SourceDiscrepancy source = compare(data, regions, beating_run(1));
  const Moment& widest = *fullest_moment(source);
  EXPECT_DOUBLE_EQ(widest.time, 0.5);
  const std::vector<SliceView> views = slices_at(widest, data, beating_lumen(), beating_run(1));
  ASSERT_EQ(views.size(), 2U);
  for (const SliceView& view : views) {
    EXPECT_NEAR(mean_radius(view.model), 1.2, sag);
    EXPECT_NEAR(mean_radius(view.imaged), 1.0, sag);
    EXPECT_NEAR(mean_radius(view.data), 1.2, 1e-12);
    EXPECT_EQ(view.data[0].col(0), view.data[0].rightCols(1)) << "closed";
    EXPECT_EQ(view.samples.size(), 64U);
  }
}

TEST(Slices, OfSurfacesCutAcrossTheVessel) {
  const SurfaceSeries data = beating_surfaces();
  const SourceDiscrepancy source = compare(data, regions, beating_run(1));
  const std::vector<SliceView> views = slices_at(*fullest_moment(source), data, beating_lumen(), beating_run(1));
  ASSERT_EQ(views.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(std::abs(views[i].plane.normal[2]), 1, 1e-9);
    EXPECT_NEAR(std::abs(views[i].plane.origin[2] - 2), i == 1 ? 0 : 1, 1e-9) << "quarters of a length of 4";
    EXPECT_NEAR(mean_radius(views[i].data), 1.2, sag);
    EXPECT_NEAR(mean_radius(views[i].imaged), 1.0, sag);
  }
}

TEST(Slices, TheWorstMomentIsWhereTheRunIsFarthestOff) {
  RunMotion run = beating_run(1);
  run.positions = [](double time) { return tube_at(time, Vec3(time == 0.75 ? 0.1 : 0, 0, 0)).points; };
  const SourceDiscrepancy source = compare(beating_surfaces(), regions, run);
  EXPECT_DOUBLE_EQ(worst_moment(source)->time, 0.75);
  EXPECT_DOUBLE_EQ(fullest_moment(source)->time, 0.5);
  EXPECT_EQ(worst_moment(SourceDiscrepancy{}), nullptr);
}

TEST(Slices, NodesBesideContoursHaveADistanceOthersNone) {
  const ContourSeries data = beating_contours({}, {0, 0});
  RunMotion run = beating_run(1);
  run.positions = [](double) { return tube_at(0).points; };
  const SourceDiscrepancy source = compare(data, regions, run);
  const VectorXd distance = distance_at_nodes(*fullest_moment(source), data, run);
  int known = 0;
  for (Eigen::Index i = 0; i < distance.size(); ++i) {
    const double z = run.imaged(2, i), to_slice = std::min(std::abs(z - 1.03), std::abs(z - 2.97));
    if (std::isnan(distance[i])) {
      EXPECT_GT(to_slice, 0.02);
      continue;
    }
    EXPECT_LT(to_slice, 4.0 / 24) << "a row of nodes apart";
    EXPECT_NEAR(distance[i], 0.2, sag);
    ++known;
  }
  EXPECT_GT(known, 2 * 48);
}

}  // namespace slices_test
}  // namespace tether::testing
