#pragma once

#include <memory>
#include <vector>

#include "observation_manager/measurements/triangle_surface.hpp"

namespace tether {

/// What of a triangle is closest to a point.
enum class Feature { face, edge, vertex };

/// The place of a surface that is closest to a point x, and the signed distance from x to it.
struct Closest {
  Vec3 point;            ///< on the surface
  int triangle = -1;     ///< that it lies on
  Feature feature = {};  ///< of that triangle
  double distance = 0;   ///< [length], positive where the surface lies outside x, that is x on its inner side (O.1)
  Vec3 normal;           ///< unit, outward: distance * normal = point - x (O.1)
  bool on_rim = false;   ///< the closest feature belongs to an open edge: x lies beside the surface
};

/// Signed distances to a triangulated surface: a bounding-box tree finds the closest point, the angle-weighted
/// pseudonormal of the closest face, edge or vertex gives the sign (O.2).
/// The surface may be open; its edges must have at most two triangles.
class SignedSurface {
 public:
  explicit SignedSurface(TriangleSurface surface);
  ~SignedSurface();
  SignedSurface(SignedSurface&&) noexcept;
  SignedSurface& operator=(SignedSurface&&) noexcept;

  Closest closest(const Vec3& x) const;
  /// One for each column; faster than one by one if neighbouring columns are close to each other.
  std::vector<Closest> closest(const Points& x) const;
  /// The same points again, a little moved: `guesses` holds the triangles that were closest, and gets the new ones. Of
  /// the wrong size they are not used. The result does not depend on them beyond rounding.
  std::vector<Closest> closest(const Points& x, std::vector<int>& guesses) const;

  const TriangleSurface& surface() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace tether
