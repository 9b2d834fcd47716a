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

/// A triangle and its distance from where a point was [length].
struct NearTriangle {
  int triangle;
  double distance;
};

/// What is known of the triangles around a point that moves a little from look to look.
struct Neighbourhood {
  Vec3 centre = Vec3::Zero();           ///< where the point was when they were sought
  double reach = 0;                     ///< while it is no farther from there, one of them is the closest [length]
  std::vector<NearTriangle> triangles;  ///< the closest first; none: nothing is known
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
  /// The same points again, a little moved: `known` is made and kept here. What is found does not depend on it.
  std::vector<Closest> closest(const Points& x, std::vector<Neighbourhood>& known) const;

  const TriangleSurface& surface() const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace tether
