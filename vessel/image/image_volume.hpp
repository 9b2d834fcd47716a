#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// A three-dimensional image in space: one value a voxel, x fastest. Coordinates are the patient's as ITK has them:
/// x to the left, y to the back, z to the head (LPS).
struct ImageVolume {
  std::string name;          ///< of its file, for messages
  std::array<int, 3> count;  ///< voxels along each axis of the image
  Vec3 origin;               ///< middle of the first voxel [cm]
  Vec3 spacing;              ///< between middles of voxels [cm]
  Mat3 axes;                 ///< columns: directions of the image's axes, orthonormal
  std::vector<float> values;

  std::size_t at(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(count[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(k));
  }
  /// Of the voxel that stands there among the values.
  std::array<int, 3> voxel(std::size_t number) const;
  /// Of an index along each axis, which need not be whole [cm].
  Vec3 place(const Vec3& index) const { return origin + axes * spacing.cwiseProduct(index); }
  Vec3 place(std::size_t number) const;
  Vec3 index(const Vec3& place) const { return (axes.transpose() * (place - origin)).cwiseQuotient(spacing); }
  /// Whether a voxel, not only the middle of one, lies there.
  bool holds(const Vec3& place) const;
  /// The voxel that holds a place of the image.
  std::size_t nearest(const Vec3& place) const;
  /// "(-3, 1, 0) to (9.2, 13.2, 30) cm": the corners of the box around it.
  std::string extent() const;
  /// Of the longest to the shortest side of a voxel.
  double anisotropy() const { return spacing.maxCoeff() / spacing.minCoeff(); }
};

}  // namespace tether
