#pragma once

#include <memory>

#include "common/mesh/triangle_locator.hpp"

namespace tether {

/// Distance along a surface from a curve. From places along it the distance is exact on the triangles (Xin and Wang
/// 2009, of CGAL); between two of them it is that of a flat triangle to its side. Its error falls with the square of
/// the edges' length (decision 0101). Farther away than `within`: no less than that.
class GeodesicDistance {
 public:
  /// curve: one column a point, in order; straight between them; brought to where the surface's normal points to it.
  /// One column: a point. surface must outlive this. Throws InputError for no point.
  GeodesicDistance(const TriangleLocator& surface, const Points& curve, double within);
  ~GeodesicDistance();

  /// At a place of a triangle [length].
  double at(int triangle, const Vec3& barycentric) const;

 private:
  struct Paths;
  std::unique_ptr<Paths> paths_;
};

}  // namespace tether
