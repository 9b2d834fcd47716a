#include "fsi_master/transfer/overlap.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace tether {
namespace {

using Polygon = std::vector<Vec3>;  // barycentric, counterclockwise

/// The part of a convex polygon where the coordinate is not negative (Sutherland and Hodgman, CACM 17, 1974).
Polygon clipped(const Polygon& polygon, int coordinate) {
  Polygon inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = a(coordinate), at_b = b(coordinate);
    if (at_a >= 0) inside.push_back(a);
    if ((at_a >= 0) != (at_b >= 0)) inside.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return inside;
}

double share_of(const Mat3& corners) {
  return corners.determinant();  // of the triangle's area, in barycentric coordinates
}

constexpr double sliver = 1e-12;  // of the triangle's area: round-off of the clipping

}  // namespace

std::vector<OverlapPiece> overlap(const Mat3& corners, const TriangleLocator& surface) {
  const TrianglePlane plane(corners);
  double reach = 0;  // how far the surface is at the corners, and as much again as they are apart
  for (int i = 0; i < 3; ++i)
    reach = std::max({reach, surface.nearest(corners.col(i)).distance, (corners.col(i) - plane.middle).norm()});
  std::vector<OverlapPiece> pieces;
  const auto add_pieces_beside = [&](int other) {
    const Mat3 beside = surface.points()(Eigen::all, surface.triangles()[static_cast<std::size_t>(other)]);
    Mat3 seen;
    for (int i = 0; i < 3; ++i) seen.col(i) = plane.barycentric(beside.col(i));
    if (share_of(seen) <= sliver) return;  // it looks the other way
    Polygon polygon{seen.col(0), seen.col(1), seen.col(2)};
    for (int coordinate = 0; coordinate < 3 && polygon.size() >= 3; ++coordinate)
      polygon = clipped(polygon, coordinate);
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      OverlapPiece piece{other, {}};
      piece.corners << polygon[0], polygon[i - 1], polygon[i];
      if (share_of(piece.corners) <= sliver) continue;
      const Vec3 middle = corners * piece.corners.rowwise().mean();
      if (surface.nearest(middle).triangle == other) pieces.push_back(piece);
    }
  };
  surface.overlapping(corners.rowwise().minCoeff().array() - reach, corners.rowwise().maxCoeff().array() + reach,
                      add_pieces_beside);
  return pieces;
}

}  // namespace tether
