#pragma once

#include "common/base/types.hpp"

namespace tether {

/// A layer that stands on a triangle: how far it is from the prism of that base and the asked heights, at the three
/// corners of its base, its middle and its top. T = [edge edge upward](actual) [edge edge upward](asked)^-1 (M.1).
class PrismShape {
 public:
  /// base: one column a corner; heights: asked at each corner [length].
  PrismShape(const Mat3& base, const Vec3& heights);

  /// The smallest det T: 1 for the asked prism, 0 or less where it folds.
  double worst(const Mat3& top) const;

  /// Mean over the places of |T|^2 / (3 chi(det T)^(2/3)) (M.2), with chi(D) = (D + sqrt(D^2 + softening^2)) / 2,
  /// finite for folded prisms too (Garanzha, Kaporin, Kudryavtseva, Protais, Ray and Sokolov, Foldover-free maps in 50
  /// lines of code, 2021). Adds its derivative by the top's corners, one column each.
  double energy(const Mat3& top, double softening, Mat3& derivative) const;

 private:
  template <class Visit>
  void at_places(const Mat3& top, Visit visit) const;

  Mat3 base_;
  std::array<Mat3, 3> to_asked_;  ///< inverse of [edge edge upward] as asked, a corner each
};

}  // namespace tether
