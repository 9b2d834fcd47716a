#pragma once

#include <functional>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// A triangulated surface as a file holds it: triangles counterclockwise seen from outside the lumen.
struct TriangleSurface {
  Points points;  ///< [length]
  std::vector<Triangle> triangles;
};

/// The triangles that `keep` says, with their points.
TriangleSurface part_of(const TriangleSurface& surface, const std::vector<bool>& keep);

/// The triangles of which all three points are kept.
TriangleSurface part_where(const TriangleSurface& surface, const std::function<bool(const Vec3&)>& kept);

}  // namespace tether
