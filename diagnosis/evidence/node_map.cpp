#include "diagnosis/evidence/node_map.hpp"

#include "common/mesh/surface.hpp"
#include "observation_manager/measurements/signed_surface.hpp"

namespace tether {

NodeMap::NodeMap(const LumenSurface& lumen, const LumenSurface& other)
    : imaged_(lumen.points), rest_(other.points), corners_(3, lumen.points.cols()), shares_(3, lumen.points.cols()) {
  const std::vector<Closest> closest = SignedSurface({other.points, other.triangles}).closest(lumen.points);
  for (Eigen::Index i = 0; i < imaged_.cols(); ++i) {
    const Closest& place = closest[static_cast<std::size_t>(i)];
    const Triangle& t = other.triangles[static_cast<std::size_t>(place.triangle)];
    corners_.col(i) << t[0], t[1], t[2];
    shares_.col(i) =
        closest_in_triangle(place.point, other.points.col(t[0]), other.points.col(t[1]), other.points.col(t[2]));
  }
}

FinishedMotion NodeMap::operator()(const FinishedMotion& run) const {
  FinishedMotion mapped = run;
  mapped.motion.imaged = imaged_;
  mapped.motion.positions = [map = *this, positions = run.motion.positions](double time) {
    const Points moved = positions(time) - map.rest_;
    Points result = map.imaged_;
    for (Eigen::Index i = 0; i < result.cols(); ++i)
      for (Eigen::Index k = 0; k < 3; ++k) result.col(i) += map.shares_(k, i) * moved.col(map.corners_(k, i));
    return result;
  };
  return mapped;
}

}  // namespace tether
