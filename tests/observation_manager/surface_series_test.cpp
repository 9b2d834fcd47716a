#include "observation_manager/measurements/surface_series.hpp"

#include <gtest/gtest.h>

#include "common/mesh/surface.hpp"
#include "tests/observation_manager/lumens.hpp"

namespace tether::testing {
namespace {

/// Concentric spheres of the same triangles: the distance from node to node is exact.
SurfaceSeries spheres(const std::vector<double>& times, const std::vector<double>& radii,
                      const SourceSettings& settings, const std::vector<bool>& held_out = {}) {
  std::vector<SurfaceFrame> frames;
  for (std::size_t i = 0; i < times.size(); ++i) frames.push_back({times[i], scaled(sphere(6), radii[i]), {}});
  return {settings, std::move(frames), held_out, lumen(sphere(6))};
}

/// Distance and normal of the first sample: all are alike but for the facets.
double distance_at(const SurfaceSeries& series, double time) {
  const std::vector<Sample> samples = series.observe(sphere(6).points, time);
  EXPECT_EQ(samples[0].excluded, Exclusion::none) << time;
  return samples[0].distance;
}

TEST(SurfaceSeries, InterpolatesDistancesAndNormalsInTime) {
  const SurfaceSeries series = spheres({0.1, 0.3, 0.4}, {1.0, 1.2, 0.9}, settings_for(lumen(sphere(6))));
  const double out = distance_at(series, 0.3), in = distance_at(series, 0.4);
  EXPECT_LT(out, 0.2);  // to the facet beside the node, which is inclined by less than 0.2
  EXPECT_GT(out, 0.2 * std::cos(0.2));
  EXPECT_NEAR(in, -0.1, 1e-14);
  EXPECT_NEAR(distance_at(series, 0.1), 0, 1e-14);
  EXPECT_NEAR(distance_at(series, 0.2), out - in / 3, 1e-14);  // on the parabola through the three
  EXPECT_NEAR(distance_at(series, 0.375), 0.34375 * out + 0.6875 * in, 1e-14);
  const Points x = sphere(6).points;
  const std::vector<Sample> samples = series.observe(x, 0.35);
  for (Eigen::Index i = 0; i < x.cols(); ++i)
    EXPECT_GT(samples[static_cast<std::size_t>(i)].normal.dot(x.col(i)), std::cos(0.2));
}

TEST(SurfaceSeries, SaysNothingOutsideItsTimesUnlessPeriodic) {
  SourceSettings settings = settings_for(lumen(sphere(6)));
  const SurfaceSeries once = spheres({0.1, 0.3}, {1.0, 1.2}, settings);
  for (const double time : {0.0, 0.31, 1.1}) {
    const std::vector<Sample> samples = once.observe(sphere(6).points, time);
    EXPECT_EQ(count_exclusions(samples)[static_cast<std::size_t>(Exclusion::no_frame)], samples.size());
    EXPECT_EQ(misfit(samples), 0);
  }
  settings.period = 0.8;
  const SurfaceSeries beat = spheres({0.1, 0.3}, {1.0, 1.2}, settings);
  const double out = distance_at(beat, 0.3);
  EXPECT_NEAR(distance_at(beat, 0.6), 0.5 * out, 1e-14);  // halfway from 0.3 to 0.9
  EXPECT_NEAR(distance_at(beat, 0.0), 1.0 / 6 * out, 1e-14);
  EXPECT_NEAR(distance_at(beat, 0.6 + 5 * 0.8), 0.5 * out, 1e-13);
}

TEST(SurfaceSeries, WorksWithASingleFrame) {
  SourceSettings settings = settings_for(lumen(sphere(6)));
  settings.time_tolerance = 1e-3;
  const SurfaceSeries timeless = spheres({std::nan("")}, {0.9}, settings);
  EXPECT_NEAR(distance_at(timeless, 17), -0.1, 1e-14);
  const SurfaceSeries at_once = spheres({0.5}, {0.9}, settings);
  EXPECT_NEAR(distance_at(at_once, 0.5005), -0.1, 1e-14);
  EXPECT_EQ(at_once.observe(sphere(6).points, 0.502)[0].excluded, Exclusion::no_frame);
}

TEST(SurfaceSeries, NeverUsesHeldOutFramesForTimesInBetween) {
  const SurfaceSeries series =
      spheres({0, 0.1, 0.2}, {1.0, 0.5, 1.2}, settings_for(lumen(sphere(6))), {false, true, false});
  EXPECT_NEAR(distance_at(series, 0.1), 0.5 * distance_at(series, 0.2), 1e-14);
  const std::vector<Frame> frames = series.frames();
  EXPECT_TRUE(frames[1].held_out);
  EXPECT_NEAR(series.observe(sphere(6).points, frames[1])[0].distance, -0.5, 1e-14);
}

/// Where a neighbour of the two frames around shows nothing, these two still do.
TEST(SurfaceSeries, GoesByTheChordWhereANeighbourShowsNothing) {
  SourceSettings settings = settings_for(lumen(sphere(6)));
  settings.trust_distance = 0.4;
  const std::vector<double> times{0, 0.1, 0.2, 0.3}, radii{1.5, 1.0, 1.2, 1.1};
  const SurfaceSeries far = spheres(times, radii, settings);
  EXPECT_NEAR(distance_at(far, 0.15), 0.5 * distance_at(far, 0.2), 1e-14);
  EXPECT_EQ(far.observe(sphere(6).points, 0.05)[0].excluded, Exclusion::too_far);
  settings.trust_distance = 1;
  const SurfaceSeries near = spheres(times, radii, settings);
  EXPECT_NEAR(distance_at(near, 0.15),
              (9 * distance_at(near, 0.2) - distance_at(near, 0) - distance_at(near, 0.3)) / 16, 1e-14);
}

TEST(SurfaceSeries, CountsWhyItDoesNotObserve) {
  const LumenSurface model = lumen(tube(32, 20, 4, [](double) { return 1.0; }));
  SourceSettings settings = settings_for(model);
  settings.trust_distance = 0.35;
  for (std::size_t node = 0; node < settings.of_node.size(); ++node)
    if (model.points(2, static_cast<Eigen::Index>(node)) > 3.5) settings.of_node[node] = Exclusion::masked;
  // Cropped: from z = 1 to 4; too wide below z = 2.
  TriangleSurface data = tube(48, 30, 3, [](double z) { return z < 1 ? 1.5 : 1.1; });
  data.points.row(2).array() += 1;
  const SurfaceSeries series(settings, {{std::nan(""), data, {}}}, {}, model);
  const std::vector<Sample> samples = series.observe(model.points, 0);
  const auto counts = count_exclusions(samples);
  const auto count = [&](Exclusion why) { return counts[static_cast<std::size_t>(why)]; };
  EXPECT_EQ(count(Exclusion::masked), 3 * 32);  // z = 3.6, 3.8, 4
  EXPECT_GE(count(Exclusion::rim), 5 * 32);     // z = 0 .. 0.8
  EXPECT_GT(count(Exclusion::too_far), 2 * 32);
  EXPECT_GT(count(Exclusion::none), 5 * 32);
  double weight = 0;
  for (const Sample& s : samples) {
    weight += s.weight;
    EXPECT_EQ(s.weight > 0, s.excluded == Exclusion::none);
  }
  EXPECT_LT(weight, 0.6 * nodal_areas(model.points, model.triangles).sum());
}

TEST(SurfaceSeries, MisfitOfAnInflatedTubeIsItsAreaTimesTheSquare) {
  const LumenSurface model = lumen(tube(64, 20, 4, [](double) { return 1.0; }));
  const SurfaceSeries series(settings_for(model), {{std::nan(""), tube(64, 20, 4, [](double) { return 1.1; }), {}}}, {},
                             model);
  const std::vector<Sample> samples = series.observe(model.points, 0);
  double area = 0;
  for (const Sample& s : samples) area += s.weight;
  EXPECT_NEAR(misfit(samples), 0.01 * area, 1e-4 * area);  // facets: 1 - cos(pi/64)
  EXPECT_GT(area, 0.5 * nodal_areas(model.points, model.triangles).sum());
}

}  // namespace
}  // namespace tether::testing
