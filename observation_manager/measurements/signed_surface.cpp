#include "observation_manager/measurements/signed_surface.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"
#include "observation_manager/measurements/pseudonormals.hpp"

namespace tether {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Corners = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Corners::const_iterator>;
using BoxTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Kernel::Point_3 as_cgal(const Vec3& x) {
  return {x[0], x[1], x[2]};
}

Corners corners_of(const TriangleSurface& surface) {
  Corners corners;
  corners.reserve(surface.triangles.size());
  for (const auto& [a, b, c] : surface.triangles)
    corners.emplace_back(as_cgal(surface.points.col(a)), as_cgal(surface.points.col(b)),
                         as_cgal(surface.points.col(c)));
  return corners;
}

/// A place on a triangle by its barycentric coordinates: those of the other vertices are exactly zero at a vertex, that
/// of the opposite vertex on an edge.
struct Foot {
  Vec3 shares, point;

  Feature feature() const {
    const auto zeros = (shares.array() == 0).count();
    return zeros == 0 ? Feature::face : zeros == 1 ? Feature::edge : Feature::vertex;
  }
  std::size_t vertex() const { return shares[0] != 0 ? 0 : shares[1] != 0 ? 1 : 2; }
  /// The one from this vertex to the next.
  std::size_t edge() const { return shares[0] == 0 ? 1 : shares[1] == 0 ? 2 : 0; }
};

/// A place on a triangle of a surface, and how far it is from a point.
struct Near {
  int triangle;
  Foot place;
  double squared;  ///< distance
};

Near near_of(const TriangleSurface& surface, int triangle, const Vec3& x) {
  const Triangle& t = surface.triangles[static_cast<std::size_t>(triangle)];
  const auto corner = [&](std::size_t i) { return Vec3(surface.points.data() + 3 * t[i]); };
  const Vec3 a = corner(0), b = corner(1), c = corner(2), shares = closest_in_triangle(x, a, b, c);
  const Vec3 point = shares[0] * a + shares[1] * b + shares[2] * c;
  return {triangle, {shares, point}, (point - x).squaredNorm()};
}

/// Of two that are as close, a triangle that comes first: what is found does not depend on the order of a search.
bool is_closer(const Near& one, const Near& other) {
  return one.squared != other.squared ? one.squared < other.squared : one.triangle < other.triangle;
}

/// How CGAL's tree is searched: the nearer box first, boxes farther than a limit not at all. (CGAL's own search has a
/// fixed order.)
class BoxSearch {
 public:
  BoxSearch(const TriangleSurface& surface, Corners::const_iterator first, const Vec3& x)
      : surface_(surface), first_(first), x_(x) {}

  // What AABB_tree::traversal_with_priority asks for.
  static constexpr bool go_further() { return true; }
  template <class Node>
  bool do_intersect(const Vec3&, const Node& node) const {
    return squared_distance(node) <= limit_;
  }
  using Priority = double;
  template <class Node>
  std::pair<bool, Priority> do_intersect_with_priority(const Vec3&, const Node& node) const {
    const double squared = squared_distance(node);
    return {squared <= limit_, -squared};
  }

 protected:
  Near of(int triangle) const { return near_of(surface_, triangle, x_); }
  Near of(const Primitive& primitive) const { return of(static_cast<int>(primitive.id() - first_)); }
  /// Boxes and places differ by rounding: what lies no farther than this beyond the distance is looked at, too.
  void look_as_far_as(double squared, double rounding) { limit_ = std::pow(std::sqrt(squared) + rounding, 2); }

 private:
  template <class Node>
  double squared_distance(const Node& node) const {
    const auto& box = node.bbox();
    const Vec3 low(box.xmin(), box.ymin(), box.zmin()), high(box.xmax(), box.ymax(), box.zmax());
    return (low - x_).cwiseMax(x_ - high).cwiseMax(0).squaredNorm();
  }
  const TriangleSurface& surface_;
  Corners::const_iterator first_;
  Vec3 x_;
  double limit_ = std::numeric_limits<double>::infinity();  ///< squared
};

class ClosestSearch : public BoxSearch {
 public:
  ClosestSearch(const TriangleSurface& surface, Corners::const_iterator first, const Vec3& x, int guess,
                double rounding)
      : BoxSearch(surface, first, x), best_(of(guess)), rounding_(rounding) {
    look_as_far_as(best_.squared, rounding_);
  }
  const Near& best() const { return best_; }
  void intersection(const Vec3&, const Primitive& primitive) {
    const Near found = of(primitive);
    if (!is_closer(found, best_)) return;
    best_ = found;
    look_as_far_as(best_.squared, rounding_);
  }

 private:
  Near best_;
  double rounding_;
};

constexpr std::size_t kept_triangles = 16;  ///< a triangle of a regular surface and those that touch it are 13

/// The kept_triangles closest ones and one more, in the order of their distance.
class NeighbourSearch : public BoxSearch {
 public:
  /// known: of any triangles; as many as are sought tell how far to look.
  NeighbourSearch(const TriangleSurface& surface, Corners::const_iterator first, const Vec3& x,
                  const std::vector<NearTriangle>& known, double rounding)
      : BoxSearch(surface, first, x), rounding_(rounding) {
    found_.reserve(kept_triangles + 2);
    if (known.size() <= kept_triangles) return;
    double farthest = 0;
    for (const NearTriangle& near : known) farthest = std::max(farthest, of(near.triangle).squared);
    look_as_far_as(farthest, rounding_);
  }
  const std::vector<Near>& found() const { return found_; }
  void intersection(const Vec3&, const Primitive& primitive) {
    const Near near = of(primitive);
    found_.insert(std::upper_bound(found_.begin(), found_.end(), near, is_closer), near);
    if (found_.size() > kept_triangles + 1) found_.pop_back();
    if (found_.size() > kept_triangles) look_as_far_as(found_.back().squared, rounding_);
  }

 private:
  std::vector<Near> found_;
  double rounding_;
};

}  // namespace

struct SignedSurface::Tree {
  explicit Tree(TriangleSurface given)
      : surface(std::move(given)),
        normals(surface),
        corners(corners_of(surface)),
        boxes(corners.cbegin(), corners.cend()),
        rounding(1e-13 * surface.points.cwiseAbs().maxCoeff()) {
    TETHER_ASSERT(!surface.triangles.empty(), "a surface without triangles");
    boxes.build();
  }

  /// `guess`: any triangle, best a close one.
  Closest closest(const Vec3& x, int guess) const {
    ClosestSearch search(surface, corners.cbegin(), x, guess, rounding);
    boxes.traversal_with_priority(x, search);
    return described(x, search.best());
  }

  Closest closest(const Vec3& x, Neighbourhood& known) const {
    const double moved = known.triangles.empty() ? 0 : (x - known.centre).norm();
    if (known.triangles.empty() || moved > known.reach) return around(x, known);
    Near best = near_of(surface, known.triangles.front().triangle, x);
    for (std::size_t i = 1; i < known.triangles.size(); ++i) {
      const auto& [triangle, distance] = known.triangles[i];
      if (distance - moved > std::sqrt(best.squared) + rounding) break;
      const Near here = near_of(surface, triangle, x);
      if (is_closer(here, best)) best = here;
    }
    return described(x, best);
  }

  /// Whatever is not known is farther by twice the reach than what is closest, and each comes closer by no more than
  /// the point moves.
  Closest around(const Vec3& x, Neighbourhood& known) const {
    NeighbourSearch search(surface, corners.cbegin(), x, known.triangles, rounding);
    boxes.traversal_with_priority(x, search);
    const std::vector<Near>& found = search.found();
    known.centre = x;
    known.triangles.clear();
    for (const Near& near : found) known.triangles.push_back({near.triangle, std::sqrt(near.squared)});
    const double gap = known.triangles.back().distance - known.triangles.front().distance;
    known.reach =
        found.size() > kept_triangles ? std::max(0.0, gap / 2 - rounding) : std::numeric_limits<double>::infinity();
    return described(x, found.front());
  }

  Closest described(const Vec3& x, const Near& found) const {
    const auto& [triangle, place, squared] = found;
    const TriangleNormals& n = normals.triangles[static_cast<std::size_t>(triangle)];
    const Feature feature = place.feature();
    Vec3 pseudonormal = n.face;
    bool on_rim = false;
    if (feature == Feature::edge) {
      pseudonormal = n.edge[place.edge()].normalized();
      on_rim = n.edge_on_rim[place.edge()];
    } else if (feature == Feature::vertex) {
      const std::size_t i = place.vertex();
      pseudonormal = normals.vertex(surface.triangles[static_cast<std::size_t>(triangle)][i]);
      on_rim = n.vertex_on_rim[i];
    }
    const Vec3 arm = place.point - x;
    const double length = arm.norm(), distance = pseudonormal.dot(arm) < 0 ? -length : length;  // (O.2)
    const bool has_direction = feature != Feature::face && length > rounding;
    const Vec3 normal = has_direction ? Vec3(arm / distance) : pseudonormal;  // (O.1)
    return {place.point, triangle, feature, distance, normal, on_rim};
  }

  TriangleSurface surface;
  Pseudonormals normals;
  Corners corners;
  BoxTree boxes;
  double rounding;  ///< a shorter arm has no direction [length]
};

SignedSurface::SignedSurface(TriangleSurface surface) : tree_(std::make_unique<Tree>(std::move(surface))) {}
SignedSurface::~SignedSurface() = default;
SignedSurface::SignedSurface(SignedSurface&&) noexcept = default;
SignedSurface& SignedSurface::operator=(SignedSurface&&) noexcept = default;

Closest SignedSurface::closest(const Vec3& x) const {
  return tree_->closest(x, 0);
}

std::vector<Closest> SignedSurface::closest(const Points& x) const {
  std::vector<Closest> found;
  found.reserve(static_cast<std::size_t>(x.cols()));
  for (const auto& point : x.colwise())
    found.push_back(tree_->closest(point, found.empty() ? 0 : found.back().triangle));
  return found;
}

std::vector<Closest> SignedSurface::closest(const Points& x, std::vector<Neighbourhood>& known) const {
  known.resize(static_cast<std::size_t>(x.cols()));
  std::vector<Closest> found;
  found.reserve(known.size());
  for (std::size_t i = 0; i < known.size(); ++i)
    found.push_back(tree_->closest(x.col(static_cast<Eigen::Index>(i)), known[i]));
  return found;
}

const TriangleSurface& SignedSurface::surface() const {
  return tree_->surface;
}

}  // namespace tether
