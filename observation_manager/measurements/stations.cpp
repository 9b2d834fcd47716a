#include "observation_manager/measurements/stations.hpp"

#include <algorithm>
#include <numeric>

#include "common/base/error.hpp"

namespace tether {
namespace {

/// A piece in its plane, with the distance of each of its points along it.
struct FlatPiece {
  Eigen::Matrix2Xd points;  ///< a closed piece ends with its first point
  std::vector<double> along;

  FlatPiece(const CutPiece& piece, const SlicePlane& plane) {
    const Eigen::Index given = piece.points.cols(), count = given + (piece.closed ? 1 : 0);
    points.resize(2, count);
    along.push_back(0);
    for (Eigen::Index i = 0; i < count; ++i) {
      points.col(i) = plane.flat(piece.points.col(i % given));
      if (i > 0) along.push_back(along.back() + (points.col(i) - points.col(i - 1)).norm());
    }
  }
  double length() const { return along.back(); }
  double segment(std::size_t i) const { return along[i + 1] - along[i]; }
  Vec2 point(std::size_t i) const { return points.col(static_cast<Eigen::Index>(i)); }

  Vec2 middle() const {
    Vec2 sum = Vec2::Zero();
    for (std::size_t i = 0; i + 1 < along.size(); ++i) sum += segment(i) * 0.5 * (point(i) + point(i + 1));
    return sum / length();
  }

  /// Distance along the piece to its outermost crossing of the ray; 0 if there is none.
  double ray_crossing() const {
    const Vec2 from = middle();
    double farthest = 0, result = 0;
    for (std::size_t i = 0; i + 1 < along.size(); ++i) {
      const Vec2 a = point(i) - from, b = point(i + 1) - from;
      if ((a[1] >= 0) == (b[1] >= 0)) continue;
      const double t = a[1] / (a[1] - b[1]), reach = a[0] + t * (b[0] - a[0]);
      if (reach > farthest) farthest = reach, result = along[i] + t * segment(i);
    }
    return result;
  }
};

/// (1 - t) a + t b, where a and b lie on edges of one triangle.
SurfacePlace mixed(const SurfacePlace& a, const SurfacePlace& b, double t) {
  SurfacePlace result{{-1, -1, -1}, {0, 0, 0}};
  const auto add = [&](int node, double share) {
    for (std::size_t i = 0; i < 3; ++i) {
      if (result.nodes[i] != node && result.nodes[i] != -1) continue;
      result.nodes[i] = node;
      result.shares[static_cast<Eigen::Index>(i)] += share;
      return;
    }
    TETHER_ASSERT(false, "a segment of four nodes");
  };
  for (std::size_t i = 0; i < 2; ++i) {
    add(a.nodes[i], (1 - t) * a.shares[static_cast<Eigen::Index>(i)]);
    add(b.nodes[i], t * b.shares[static_cast<Eigen::Index>(i)]);
  }
  return result;
}

}  // namespace

std::vector<CutStation> stations_along(const CutPiece& piece, const SlicePlane& plane, int count) {
  const FlatPiece flat(piece, plane);
  const double first = piece.closed ? flat.ray_crossing() : 0;
  std::vector<CutStation> stations;
  if (!(flat.length() > 0)) return stations;
  for (int j = 0; j < count; ++j) {
    double s = first + (j + 0.5) / count * flat.length();
    if (s > flat.length()) s -= flat.length();
    const auto above = std::upper_bound(flat.along.begin() + 1, flat.along.end() - 1, s);
    const auto i = static_cast<std::size_t>(above - flat.along.begin()) - 1;
    const double t = flat.segment(i) > 0 ? std::clamp((s - flat.along[i]) / flat.segment(i), 0.0, 1.0) : 0;
    const std::size_t next = (i + 1) % piece.places.size();
    const Vec3 a = piece.points.col(static_cast<Eigen::Index>(i)),
               b = piece.points.col(static_cast<Eigen::Index>(next));
    const Vec2 along = (flat.point(i + 1) - flat.point(i)).normalized();
    stations.push_back({mixed(piece.places[i], piece.places[next], t), (1 - t) * a + t * b, {along[1], -along[0]}});
  }
  return stations;
}

}  // namespace tether
