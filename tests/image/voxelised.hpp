#pragma once

#include <cmath>
#include <functional>

#include "twin/random.hpp"
#include "twin/voxels.hpp"
#include "vessel/image/image_volume.hpp"

namespace tether::testing {

/// How a scanner shows a lumen: grey values, blur and noise.
struct Scan {
  double voxel = 0.1;               ///< [cm]
  Vec3 shape = Vec3::Ones();        ///< of a voxel, times `voxel`
  double blur = 0.7;                ///< deviation, in voxels
  double lumen = 350, tissue = 50;  ///< grey values
  double noise = 15;                ///< deviation of each voxel's value
  Mat3 axes = Mat3::Identity();     ///< of the image
  double rim = 0.6;                 ///< about the vessel [cm]
  std::uint64_t seed = 1;
};

/// Along one axis; beyond the border as at the border.
inline void blur_axis(VoxelImage& image, std::size_t axis, double deviation) {
  const auto [nx, ny, nz] = image.count;
  const int count = image.count[axis], half = static_cast<int>(std::ceil(4 * deviation));
  std::vector<double> weights;
  double sum = 0;
  for (int i = -half; i <= half; ++i) sum += weights.emplace_back(std::exp(-0.5 * i * i / (deviation * deviation)));
  const std::size_t stride = axis == 0 ? 1 : axis == 1 ? nx : static_cast<std::size_t>(nx) * ny;
  std::vector<float> line(count);
  for (std::size_t first = 0; first < image.values.size(); ++first) {
    if (first / stride % count != 0) continue;
    for (int i = 0; i < count; ++i) line[i] = image.values[first + stride * i];
    for (int i = 0; i < count; ++i) {
      double value = 0;
      for (int k = -half; k <= half; ++k) value += weights[k + half] / sum * line[std::clamp(i + k, 0, count - 1)];
      image.values[first + stride * i] = static_cast<float>(value);
    }
  }
}

/// Grey values around a lumen by place and distance from its wall [cm].
using Surroundings = std::function<double(const Vec3& place, double distance)>;

/// What voxels show that are not all lumen, where that is not even tissue.
inline void surround(VoxelImage& grey, const TriangleSurface& closed, const Scan& scan, const Surroundings& around) {
  const ImageVolume image{"", grey.count, grey.origin, grey.spacing, Mat3::Identity(), {}};
  Points places(3, static_cast<Eigen::Index>(grey.values.size()));
  for (Eigen::Index n = 0; n < places.cols(); ++n) places.col(n) = image.place(static_cast<std::size_t>(n));
  const std::vector<Closest> wall = SignedSurface(closed).closest(places);
  for (std::size_t n = 0; n < grey.values.size(); ++n) {
    const double value = around(places.col(static_cast<Eigen::Index>(n)), std::max(0.0, -wall[n].distance));
    grey.values[n] += static_cast<float>((1 - grey.values[n]) * (value - scan.tissue) / (scan.lumen - scan.tissue));
  }
}

/// The image of a closed lumen, by the share of each voxel that lies within it (T.3), on a grid whose place is drawn
/// from the seed.
inline ImageVolume scan_of(TriangleSurface closed, const Scan& scan, const Surroundings& around = {}) {
  closed.points = scan.axes.transpose() * closed.points;
  Random random(scan.seed, 0);
  const Vec3 spacing = scan.voxel * scan.shape, part(random.uniform(), random.uniform(), random.uniform());
  VoxelImage grey = coverage(closed, spacing, part.cwiseProduct(spacing), scan.rim);
  if (around) surround(grey, closed, scan, around);
  if (scan.blur > 0)
    for (std::size_t axis = 0; axis < 3; ++axis) blur_axis(grey, axis, scan.blur);
  ImageVolume image{"scan", grey.count, scan.axes * grey.origin, grey.spacing, scan.axes, std::move(grey.values)};
  for (float& value : image.values)
    value = static_cast<float>(scan.tissue + (scan.lumen - scan.tissue) * value + scan.noise * random.normal());
  return image;
}

/// Without what lies outside of these voxels: the lumen then leaves the image.
inline ImageVolume cropped(const ImageVolume& image, std::array<int, 3> low, std::array<int, 3> high) {
  ImageVolume part = image;
  part.values.clear();
  part.origin = image.place(Vec3(low[0], low[1], low[2]));
  for (std::size_t axis = 0; axis < 3; ++axis) part.count[axis] = high[axis] - low[axis] + 1;
  for (int k = low[2]; k <= high[2]; ++k)
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = low[0]; i <= high[0]; ++i) part.values.push_back(image.values[image.at(i, j, k)]);
  return part;
}

/// 1 where at least half of the grey contrast is.
inline ImageVolume labelled(ImageVolume image, double limit, float label = 1) {
  for (float& value : image.values) value = value >= limit ? label : 0;
  return image;
}

}  // namespace tether::testing
