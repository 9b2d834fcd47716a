#pragma once

#include <string>
#include <vector>

#include "common/mesh/patch.hpp"

/// Triangles cut where functions that are linear on them have a value: how regions share them exactly.
namespace tether {

/// A convex piece of a triangle: its corners in the triangle's barycentric coordinates.
using Polygon = std::vector<Vec3>;
using Polygons = std::vector<Polygon>;
Polygon whole_triangle();

/// A border: where a function, linear on the triangle and given at its corners, has a value.
struct Border {
  Vec3 function;
  double value, tolerance;
  double beyond(const Vec3& x) const { return function.dot(x) - value; }
};

/// What of the polygon is on the side where the function is less, and what on the other; none if it only touches.
struct Halves {
  Polygon less, more;
};
Halves split(const Polygon& polygon, const Border& border);

/// A border of a region, what is beyond it being outside.
struct Side {
  Border border;
  bool inside_is_less;
};
/// Takes what lies within all sides out of `left`.
Polygons taken(Polygons& left, const std::vector<Side>& sides);

/// Parts of the triangle, without slivers of less than 1e-9 of it.
std::vector<TrianglePart> triangulated(const Polygon& polygon, const Triangle& of);

/// Patches of a surface, filled triangle by triangle.
class SharedPatches {
 public:
  explicit SharedPatches(const std::vector<std::string>& names);
  /// What each patch has of a triangle. The one with the most names it.
  void add(const Triangle& triangle, const std::vector<std::vector<TrianglePart>>& shares);
  /// Without parts if no border cuts a triangle.
  std::vector<Patch> finished();

 private:
  std::vector<Patch> patches_;
  bool any_cut_ = false;
};

}  // namespace tether
