// What data may be off by in all frames alike: what it is, and what it makes of an estimate.
#include "identification_master/lasting_columns.hpp"

#include <gtest/gtest.h>

#include "tests/identification_master/measured_tube.hpp"

namespace tether::testing {
namespace lasting_columns_test {

LastingColumns columns_of(const LastingAllowance& allowed) {
  static const Observations data = surfaces(24, 20, 0.3, -0.1, 12, 10);
  const LumenSurface model = lumen(BreathingTube::at(12, 10, 0, 0, 0));
  return {data, model, model.points, allowed, {.start = 0, .dt = 0.02, .length = BreathingTube::beat}};
}

TEST(LastingColumns, AreABiasADisplacementAndADistanceOfEachRegion) {
  const LastingColumns found = columns_of({});
  const Points x = BreathingTube::at(12, 10, 0, 0, 0).points;
  ASSERT_EQ(found.at(0).rows(), x.cols());
  const auto column = [&](const std::string& name) -> VectorXd {
    for (std::size_t k = 0; k < found.errors().size(); ++k)
      if (found.errors()[k].name == name) return found.at(0).col(static_cast<Eigen::Index>(k));
    return VectorXd::Zero(x.cols());
  };
  for (const LastingError& error : found.errors()) {
    EXPECT_EQ(error.source, "observations.surfaces.data");
    EXPECT_NEAR(error.deviation, (error.name == "all" ? 0.25 : 0.5) * deviation, 1e-15) << error.name;
  }
  EXPECT_LT((column("bias").array() - 0.5 * deviation).abs().maxCoeff(), 1e-15);
  EXPECT_LT((column("all").array() - 0.25 * deviation).abs().maxCoeff(), 1e-15) << "its only region";
  const double facet = 0.5 * deviation * std::numbers::pi / 24;  // normals are those of the measured facets
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    EXPECT_NEAR(column("x")(i), 0.5 * deviation * x(0, i) / x.col(i).head<2>().norm(), facet);
}

/// Of four successive frames, as much of each as a datum between them has; then three stay and another comes.
TEST(LastingColumns, AreADistanceOfEachRegionInEachFrame) {
  const LastingColumns found = columns_of({});
  const auto all_times = std::ssize(found.errors());
  ASSERT_EQ(found.count(), all_times + 4);
  const double gap = BreathingTube::beat / frames, a = 0.25 * deviation;
  const auto of_frames = [&](double time) { return Eigen::Vector4d(found.at(time).topRightCorner(1, 4).transpose()); };
  const Eigen::Vector4d half = a / 16 * Eigen::Vector4d(-1, 9, 9, -1);
  EXPECT_LT((of_frames(1.5 * gap) - half).norm(), 1e-12);
  EXPECT_LT((of_frames(2.5 * gap) - Eigen::Vector4d(half(3), half(0), half(1), half(2))).norm(), 1e-12);
  const MatrixXd columns = found.at(0.25 * gap).rightCols(4);
  EXPECT_LT((columns.rowwise() - columns.row(0)).norm(), 1e-12);
  EXPECT_TRUE(found.renewed(0.25 * gap, 0.75 * gap).empty());
  EXPECT_EQ(found.renewed(1.75 * gap, 2.25 * gap), std::vector<Eigen::Index>{all_times});  // 0 goes, 4 comes
  EXPECT_EQ(found.renewed(2.75 * gap, 3.25 * gap), std::vector<Eigen::Index>{all_times + 1});
  EXPECT_EQ(found.renewed(1.25 * gap, 3.25 * gap), (std::vector<Eigen::Index>{all_times, all_times + 1}));
}

TEST(LastingColumns, AreNoneIfNothingIsAllowed) {
  EXPECT_EQ(columns_of(nothing_lasts).count(), 0);
  const LastingColumns bias = columns_of({0, 0.02, 0});
  ASSERT_EQ(bias.errors().size(), 1U);
  EXPECT_EQ(bias.errors()[0].deviation, 0.02);
}

/// Surfaces that are drawn too large by 0.1 in all frames: counted as new in each frame, front and rear come out wrong
/// and sure; as what lasts, right and less sure. What widens in time is told from what stays.
TEST(LastingErrors, DoNotPassForTheParameters) {
  std::vector<SurfaceFrame> list;
  for (int k = 0; k < frames; ++k) {
    const double time = BreathingTube::beat * k / frames;
    TriangleSurface surface = BreathingTube::measured(48, 40, time, 0.3, -0.1);
    surface.points.topRows<2>() *= 1.05;
    list.push_back({time, std::move(surface), {}});
  }
  const LumenSurface model = lumen(BreathingTube::at(24, 20, 0, 0, 0));
  SourceSettings settings = settings_for(model);
  settings.period = BreathingTube::beat;
  settings.noise = {deviation, correlation, 0};
  Observations data;
  data.lumen.push_back(
      std::make_unique<SurfaceSeries>(settings, std::move(list), std::vector<bool>(frames, false), model));
  const EstimateRecord ignorant = identified(data, 24, 20, 0.02),
                       knowing = identified(data, 24, 20, 0.02, true, {0, 0.1, 0});
  EXPECT_GT(std::abs(ignorant.mean(0) - 0.3), 5 * deviations(ignorant)(0));
  EXPECT_NEAR(knowing.mean(0), 0.3, 0.015);
  EXPECT_NEAR(knowing.mean(1), -0.1, 0.015);
  EXPECT_GT(deviations(knowing)(0), 1.05 * deviations(ignorant)(0));
}

/// The tube is linear in its parameters: what the data would tell is what they tell, whatever lasts.
TEST(LastingErrors, AreAllowedForWhereNothingIsCorrected) {
  const Observations data = surfaces(24, 20, 0.3, -0.1, 24, 20);
  BreathingEnsemble ensemble(data, 24, 20);
  const IdentifiedParameters parameters = parameters_of_tube();
  const DataPrecision precision(data, ensemble.lumen(), 0.02, {0, BreathingTube::beat});
  IdentificationPlan plan{.start = 0, .dt = 0.02, .steps = 40, .largest_shift = 1e9};
  const LastingColumns lasting(data, lumen(BreathingTube::at(24, 20, 0, 0, 0)), ensemble.lumen(), {}, plan.ends());
  Identification correcting(plan, parameters, precision, data, ensemble, lasting);
  plan.corrects = false;
  Identification watching(plan, parameters, precision, data, ensemble, lasting);
  for (int step = 0; step < 17; ++step) correcting.advance();
  Identification resumed(correcting.plan(), parameters, precision, data, ensemble, lasting);
  resumed.restore(correcting.state());
  while (!correcting.is_done()) correcting.advance();
  while (!resumed.is_done()) resumed.advance();
  while (!watching.is_done()) watching.advance();
  EXPECT_EQ(correcting.last().mean, resumed.last().mean);
  EXPECT_EQ(correcting.state().lasting.mean, resumed.state().lasting.mean);
  const VectorXd ratio = deviations(watching.last()).cwiseQuotient(deviations(correcting.last()));
  EXPECT_LT((ratio.array() - 1).abs().maxCoeff(), 0.02);
}

}  // namespace lasting_columns_test
}  // namespace tether::testing
