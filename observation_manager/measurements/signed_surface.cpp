#include "observation_manager/measurements/signed_surface.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

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

/// How CGAL's tree is searched: the nearer box first, boxes farther than the best place so far not at all. (CGAL's own
/// search has a fixed order.)
class Search {
 public:
  Search(const TriangleSurface& surface, Corners::const_iterator first, const Vec3& x, int guess)
      : surface_(surface), first_(first), x_(x), triangle_(guess), best_(on(guess)) {
    squared_ = (best_.point - x_).squaredNorm();
  }
  int triangle() const { return triangle_; }
  const Foot& place() const { return best_; }

  // What AABB_tree::traversal_with_priority asks for.
  static constexpr bool go_further() { return true; }
  void intersection(const Vec3&, const Primitive& primitive) {
    const auto triangle = static_cast<int>(primitive.id() - first_);
    const Foot found = on(triangle);
    const double squared = (found.point - x_).squaredNorm();
    if (squared >= squared_) return;
    squared_ = squared;
    best_ = found;
    triangle_ = triangle;
  }
  template <class Node>
  bool do_intersect(const Vec3&, const Node& node) const {
    return squared_distance(node) < squared_;
  }
  using Priority = double;
  template <class Node>
  std::pair<bool, Priority> do_intersect_with_priority(const Vec3&, const Node& node) const {
    const double squared = squared_distance(node);
    return {squared < squared_, -squared};
  }

 private:
  Foot on(int triangle) const {
    const Triangle& t = surface_.triangles[static_cast<std::size_t>(triangle)];
    const auto corner = [&](std::size_t i) { return Vec3(surface_.points.data() + 3 * t[i]); };
    const Vec3 a = corner(0), b = corner(1), c = corner(2), shares = closest_in_triangle(x_, a, b, c);
    return {shares, shares[0] * a + shares[1] * b + shares[2] * c};
  }
  template <class Node>
  double squared_distance(const Node& node) const {
    const auto& box = node.bbox();
    const Vec3 low(box.xmin(), box.ymin(), box.zmin()), high(box.xmax(), box.ymax(), box.zmax());
    return (low - x_).cwiseMax(x_ - high).cwiseMax(0).squaredNorm();
  }
  const TriangleSurface& surface_;
  Corners::const_iterator first_;
  Vec3 x_;
  int triangle_;
  Foot best_;
  double squared_;
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
    Search search(surface, corners.cbegin(), x, guess);
    boxes.traversal_with_priority(x, search);
    return described(x, search.triangle(), search.place());
  }

  Closest described(const Vec3& x, int triangle, const Foot& place) const {
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

std::vector<Closest> SignedSurface::closest(const Points& x, std::vector<int>& guesses) const {
  std::vector<Closest> found;
  if (guesses.size() != static_cast<std::size_t>(x.cols())) {
    found = closest(x);
    guesses.resize(found.size());
  } else {
    found.reserve(guesses.size());
    for (std::size_t i = 0; i < guesses.size(); ++i)
      found.push_back(tree_->closest(x.col(static_cast<Eigen::Index>(i)), guesses[i]));
  }
  for (std::size_t i = 0; i < guesses.size(); ++i) guesses[i] = found[i].triangle;
  return found;
}

const TriangleSurface& SignedSurface::surface() const {
  return tree_->surface;
}

}  // namespace tether
