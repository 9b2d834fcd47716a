#include "fsi_master/transfer/followed_place.hpp"

#include <Eigen/Geometry>

#include "common/base/error.hpp"

namespace tether {

TrianglePlane::TrianglePlane(const Mat3& corners) : middle(corners.rowwise().mean()) {
  const Vec3 area = (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0));
  normal = area.normalized();
  for (int i = 0; i < 3; ++i)
    gradients.col(i) = area.cross(corners.col((i + 2) % 3) - corners.col((i + 1) % 3)) / area.squaredNorm();
}

FollowedPlace followed_place(const Triangle& nodes, const TrianglePlane& plane, const Vec3& point) {
  const Vec3 weights = plane.barycentric(point);
  FollowedPlace place{nodes, {}, plane.height(point)};
  for (int i = 0; i < 3; ++i)
    place.shares[static_cast<std::size_t>(i)] =
        weights(i) * Mat3::Identity() - place.height * plane.gradients.col(i) * plane.normal.transpose();  // (C.10)
  return place;
}

NearestPlace nearest_place(const TriangleLocator& surface, const Vec3& point) {
  const TriangleLocator::Nearest nearest = surface.nearest(point);
  TETHER_ASSERT(nearest.triangle >= 0, "a surface of {} triangles", surface.triangles().size());
  const Triangle& nodes = surface.triangles()[static_cast<std::size_t>(nearest.triangle)];
  return {followed_place(nodes, TrianglePlane(surface.points()(Eigen::all, nodes)), point), nearest.distance};
}

}  // namespace tether
