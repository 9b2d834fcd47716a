/// Voxels, segmentation and the surfaces around them against shapes of known size. Lengths in mm.
#include <gtest/gtest.h>

#include <numeric>

#include "common/mesh/topology.hpp"
#include "observation_manager/measurements/open_ends.hpp"
#include "tests/twin/shapes.hpp"
#include "twin/closed_lumen.hpp"
#include "twin/random.hpp"
#include "twin/voxels.hpp"

namespace tether {
namespace {

using namespace testing;

const Vec3 voxel(0.6, 0.6, 1.0);

/// Mean and standard deviation of the distances from the axis (or the origin) minus the radius, over points within
/// `half` of the middle.
struct Bias {
  double mean = 0, deviation = 0;
};
Bias bias_of(const Points& points, double radius, const Vec3& axis, double half) {
  double sum = 0, squares = 0, count = 0;
  for (const auto& x : points.colwise()) {
    if (std::abs(x.dot(axis)) > half) continue;
    const double error = (x - x.dot(axis) * axis).norm() - radius;
    sum += error, squares += error * error, ++count;
  }
  return {sum / count, std::sqrt(squares / count - sum * sum / (count * count))};
}

Bias bias_of_tube(double radius, const Vec3& axis, const Segmentation& how, int seed) {
  Random random(static_cast<std::uint64_t>(seed), 0);
  const Vec3 shift(random.uniform(), random.uniform(), random.uniform());
  const TriangleSurface closed = closed_lumen(tube(radius, 40, 120, 40, axis), 8);
  return bias_of(segmented(coverage(closed, voxel, shift.cwiseProduct(voxel), 6), how).points, radius, axis, 16);
}

TEST(ClosedLumen, IsTheLumenDrawnOutAndClosed) {
  const Vec3 axis = Vec3(1, 2, 3).normalized();
  const TriangleSurface open = tube(10, 40, 60, 20, axis), closed = closed_lumen(open, 5);
  EXPECT_TRUE(open_edges(closed.triangles).empty());
  EXPECT_LT(total_area_vector(closed.points, closed.triangles).norm(), 1e-9);
  const double facets = 60 * std::sin(2 * std::numbers::pi / 60) / 2 * 100;  // area of the polygon
  EXPECT_NEAR(volume(closed) / (facets * 50), 1, 2e-3) << "turned rings twist the prisms a little";
  EXPECT_TRUE(std::equal(open.triangles.begin(), open.triangles.end(), closed.triangles.begin()));
  const auto along = axis.transpose() * closed.points;
  EXPECT_NEAR(along.maxCoeff(), 25, 1e-9);
  EXPECT_NEAR(along.minCoeff(), -25, 1e-9);
}

TEST(Rounded, LiesOffACircleByTheFourthPower) {
  const auto sag = [](int around) {  // away from the rims, whose normals are one-sided
    const TriangleSurface round = rounded(tube(10, 12, around, 6), 1);
    double most = 0;
    for (const auto& x : round.points.colwise())
      if (std::abs(x.z()) < 3.5) most = std::max(most, std::abs(10 - x.head<2>().norm()));
    return most;
  };
  EXPECT_LT(sag(24), 0.05 * 10 * (1 - std::cos(std::numbers::pi / 24))) << "a twentieth of the facets' depth";
  EXPECT_NEAR(std::log2(sag(24) / sag(48)), 4, 0.5);
  const TriangleSurface coarse = tube(10, 4, 12, 2), one = rounded(coarse, 1), other = rounded(coarse, 2);
  EXPECT_EQ(one.points.leftCols(coarse.points.cols()), coarse.points) << "goes through the same points";
  EXPECT_EQ(one.triangles.size(), 4 * coarse.triangles.size());
  EXPECT_EQ(one.triangles, other.triangles);
  EXPECT_NE(one.points, other.points) << "at seeded places";
}

TEST(Coverage, AddsUpToTheVolume) {
  for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(1, 2, 2), Vec3(-1, 0.3, 0.5)}) {
    const TriangleSurface closed = closed_lumen(tube(10, 40, 48, 20, axis.normalized()), 3);
    const VoxelImage image = coverage(closed, voxel, Vec3(0.1, 0.2, 0.3), 2);
    const double sum = std::accumulate(image.values.begin(), image.values.end(), 0.0);
    EXPECT_NEAR(sum * voxel.prod() / volume(closed), 1, 2e-3)
        << axis.transpose() << ": lines 0.15 apart, and a chord that ends like a root";
    EXPECT_EQ(image.values.front(), 0);
  }
}

/// Lines of probes that run along edges and through corners of triangles.
TEST(Coverage, OfABoxOnTheGridIsExact) {
  TriangleSurface box{Points(3, 8), {}};
  for (int i = 0; i < 8; ++i) box.points.col(i) = Vec3(i & 1 ? 3 : 0, i & 2 ? 3 : 0, i & 4 ? 2.25 : 0.5);
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  const VoxelImage image = coverage(box, Vec3(1, 1, 1), Vec3(0.5, 0.5, 0.5), 1, 4);
  for (std::size_t i = 0; i < image.values.size(); ++i) {
    const auto at = static_cast<int>(i);
    const Vec3 x = image.origin + Vec3(at % image.count[0], at / image.count[0] % image.count[1],
                                       at / (image.count[0] * image.count[1]));
    const bool across = x.x() > 0 && x.x() < 3 && x.y() > 0 && x.y() < 3;
    const double share = std::max(0.0, std::min(x.z() + 0.5, 2.25) - std::max(x.z() - 0.5, 0.5));
    EXPECT_NEAR(image.values[i], across ? share : 0, 1e-6) << x.transpose();
  }
}

TEST(Segmented, TubeIsUnbiasedWithinATenthOfAVoxel) {
  for (const bool mask : {true, false})
    for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(1, 2, 2)})
      for (const int seed : {1, 2}) {
        const Bias bias = bias_of_tube(12, axis.normalized(), {0, mask, 30}, seed);
        EXPECT_LT(std::abs(bias.mean), 0.06) << mask << " " << axis.transpose();
        EXPECT_LT(bias.deviation, mask ? 0.25 : 0.1) << mask << " " << axis.transpose();
      }
}

TEST(Segmented, SphereIsUnbiasedWithinATenthOfAVoxelAndClosed) {
  const TriangleSurface ball = sphere(12, 120, 80);
  for (const bool mask : {true, false}) {
    const TriangleSurface surface = segmented(coverage(ball, voxel, Vec3(0.2, 0.1, 0.4), 4), {0, mask, 30});
    const VectorXd radius = surface.points.colwise().norm().transpose();
    EXPECT_NEAR(radius.mean(), 12, 0.06);
    EXPECT_NEAR(std::cbrt(volume(surface) * 3 / (4 * std::numbers::pi)), 12, 0.06) << "normals outward";
    EXPECT_TRUE(open_edges(surface.triangles).empty());
  }
}

/// The level 1/2 of a blurred tube moves inward by deviation^2 / (2 radius), of a sphere twice as far.
TEST(Segmented, BlurShrinksWhatIsCurved) {
  const Vec3 axis(0, 0, 1);
  const double sharp = bias_of_tube(8, axis, {0, false, 0}, 3).mean;
  const double blurred = bias_of_tube(8, axis, {1.5, false, 0}, 3).mean;
  EXPECT_NEAR(blurred - sharp, -1.5 * 1.5 / (2 * 8), 0.02);
}

TEST(Segmented, SmoothingTakesTheStepsAway) {
  const Vec3 axis = Vec3(1, 2, 2).normalized();
  EXPECT_LT(bias_of_tube(12, axis, {0, true, 30}, 1).deviation,
            0.6 * bias_of_tube(12, axis, {0, true, 0}, 1).deviation);
}

TEST(PartOf, KeepsTrianglesWithTheirPoints) {
  const TriangleSurface whole = tube(1, 4, 8, 2);
  std::vector<bool> keep(whole.triangles.size());
  std::fill(keep.begin(), keep.begin() + 16, true);  // the first ring
  const TriangleSurface part = part_of(whole, keep);
  EXPECT_EQ(part.points.cols(), 16);
  EXPECT_EQ(part.triangles.size(), 16U);
  EXPECT_NEAR(total_area(part.points, part.triangles), total_area(whole.points, whole.triangles) / 2, 1e-12);
}

}  // namespace
}  // namespace tether
