#pragma once

#include <vector>

#include "fsi_master/transfer/followed_place.hpp"

namespace tether {

/// A piece of a triangle that lies beside one triangle of another surface.
struct OverlapPiece {
  int other;     ///< triangle
  Mat3 corners;  ///< of the piece, barycentric in its own triangle, one a column
};

/// The pieces of a triangle beside those of a surface, seen along its normal: of each place the surface's nearest
/// triangle, if it looks the same way. Together they cover the triangle but for slivers where both are curved.
std::vector<OverlapPiece> overlap(const Mat3& corners, const TriangleLocator& surface);

}  // namespace tether
