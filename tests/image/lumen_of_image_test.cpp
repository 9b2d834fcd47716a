#include <gtest/gtest.h>

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

}  // namespace
}  // namespace tether
