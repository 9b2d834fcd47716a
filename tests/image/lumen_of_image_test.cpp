#include <gtest/gtest.h>

#include "tests/image/chest.hpp"
#include "tests/image/true_lumen.hpp"
#include "tests/image/voxelised.hpp"
#include "tests/study/bent_tube.hpp"
#include "vessel/image/lumen_of_image.hpp"

/// The twin's own voxels back to the lumen that they show.
namespace tether {
namespace {

using namespace testing;

LumenImageCase by(ImageMethod method) {
  LumenImageCase how;
  if (method == ImageMethod::label) how.labels = {"1"};
  if (method == ImageMethod::threshold) how.threshold = ThresholdCase{200, {}};
  if (method == ImageMethod::level_set) how.level_set.emplace();
  return how;
}

Off off(ImageMethod method, const Truth& truth, const Scan& scan, const Vec3& seed) {
  LumenImageCase how = by(method);
  how.seeds = {{"middle", seed}};
  ImageVolume image = scan_of(truth.closed, scan);
  if (method == ImageMethod::label) image = labelled(std::move(image), 200);
  const LumenOfImage lumen = lumen_of(image, how);
  const Off result = off(lumen.surface, truth, scan.voxel);
  std::cout << fmt::format(
      "{:10} voxel {:.3g} cm: mean {:.3f} p95 {:.3f} greatest {:.2f} bias {:+.3f} voxels, {} iterations\n",
      word_of(method), scan.voxel, result.mean, result.p95, result.greatest, result.bias, lumen.summary.iterations);
  return result;
}

class EachMethod : public ::testing::TestWithParam<ImageMethod> {};
INSTANTIATE_TEST_SUITE_P(LumenOfImage, EachMethod,
                         ::testing::Values(ImageMethod::label, ImageMethod::threshold, ImageMethod::level_set),
                         [](const auto& info) { return std::string(word_of(info.param)); });

TEST_P(EachMethod, ABranchingArchIsFoundToAThirdOfAVoxel) {
  const Off found = off(GetParam(), arch(TETHER_SOURCE), {.voxel = 0.15}, {14.6, 15.2, 30.1});
  EXPECT_LT(found.mean, 1.0 / 3);
  EXPECT_LT(found.p95, 1);
}

TEST_P(EachMethod, HalfTheVoxelIsHalfAsFarOff) {
  const Truth tube = truth_of(bent_tube(96, 132));
  const Vec3 middle = tube_middle(0.5);
  const double coarse = 0.2 * off(GetParam(), tube, {.voxel = 0.2}, middle).mean;
  const double fine = 0.1 * off(GetParam(), tube, {.voxel = 0.1}, middle).mean;
  EXPECT_GT(std::log2(coarse / fine), 0.8);
}

/// A front is drawn inward by its curvature, a narrow vessel's most; what it leaves is moved to the wall.
TEST(LevelSet, ATubeSixVoxelsWideIsNoNarrower) {
  const Off found = off(ImageMethod::level_set, truth_of(bent_tube(96, 132)), {.voxel = 0.33}, tube_middle(0.5));
  EXPECT_NEAR(found.bias, 0, 0.2) << "voxels";
}

/// Walls that face thick slices are as many voxels wide as others: they hold a front as well.
TEST(LevelSet, DoesNotLeakThroughThickSlices) {
  const Truth truth = arch(TETHER_SOURCE);
  const Off found = off(ImageMethod::level_set, truth, {.voxel = 0.12, .shape = {1, 1, 3}}, {14.6, 15.2, 30.1});
  EXPECT_LT(found.mean, 1.0 / 3);
  EXPECT_LT(found.p95, 1);
}

/// Beside the bent tube a ball of almost its values, which it touches over 6 mm.
double ball_beside(const Vec3& x, double) {
  const Vec3 middle = tube_middle(0.5) + 1.9 * tube_middle(0.5).normalized();
  return (x - middle).norm() < 1 ? 290 : 50;
}

LumenImageCase seeded() {
  LumenImageCase how = by(ImageMethod::level_set);
  how.seeds = {{"middle", tube_middle(0.5)}};
  return how;
}

/// A neighbour that is named bounds the lumen where they touch, and moves its wall nowhere else.
TEST(LevelSet, ANeighbourIsKeptOutAndMovesNoWall) {
  const Truth tube = truth_of(bent_tube(96, 132));
  const ImageVolume image = scan_of(tube.closed, {.voxel = 0.12, .rim = 2.2}, ball_beside);
  LumenImageCase how = seeded();
  const Off leaked = off(lumen_of(image, how).surface, tube, 0.12);
  how.neighbours = {{"ball", tube_middle(0.5) + 2.1 * tube_middle(0.5).normalized()}};
  const Off bounded = off(lumen_of(image, how).surface, tube, 0.12);
  EXPECT_GT(leaked.mean, 1) << "else there is nothing to be kept out";
  EXPECT_LT(bounded.mean, 1.0 / 3);
  EXPECT_LT(bounded.p95, 1);
}

/// A front that finds a way through a wall is ended soon, and says so: here along the shell of a spine, which it would
/// follow into all of the tissue.
TEST(LevelSet, EndsWhereItGrowsFasterAgain) {
  const Truth truth = arch(TETHER_SOURCE);
  LumenImageCase how = by(ImageMethod::level_set);
  how.seeds = {{"ascending", {14.6, 15.2, 30.1}}};
  const LumenOfImage found = lumen_of(scan_of(truth.closed, {.voxel = 0.15, .noise = 25}, Chest{.spine = true}), how);
  EXPECT_FALSE(found.summary.stood_still);
  EXPECT_TRUE(found.summary.grew_again);
  EXPECT_LT(off(found.surface, truth, 0.15).p95, 1);
  EXPECT_NE(text_of(found.summary).find("leaks or found a vessel without a seed"), std::string::npos);
}

}  // namespace
}  // namespace tether
