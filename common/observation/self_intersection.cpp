#include "common/observation/self_intersection.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace tether {
namespace {

using Corners = Eigen::Matrix3d;  ///< one column a corner

/// Whether the segment p q passes through the inside of the triangle (Moeller and Trumbore 1997).
bool passes_through(const Vec3& p, const Vec3& q, const Corners& t) {
  constexpr double inside = 1e-9;
  const Vec3 way = q - p, e1 = t.col(1) - t.col(0), e2 = t.col(2) - t.col(0), across = way.cross(e2);
  const double determinant = e1.dot(across);
  if (std::abs(determinant) <= 1e-12 * way.norm() * e1.norm() * e2.norm()) return false;
  const Vec3 from = p - t.col(0), turned = from.cross(e1);
  const double u = from.dot(across) / determinant, v = way.dot(turned) / determinant, at = e2.dot(turned) / determinant;
  return u > inside && v > inside && u + v < 1 - inside && at > inside && at < 1 - inside;
}

class Finder {
 public:
  explicit Finder(const TriangleSurface& surface) : surface_(surface) {
    for (const Triangle& t : surface.triangles) {
      corners_.emplace_back(surface.points(Eigen::all, t));
      low_.emplace_back(corners_.back().rowwise().minCoeff());
      high_.emplace_back(corners_.back().rowwise().maxCoeff());
    }
  }

  /// Sweeps along the longest axis, comparing triangles whose boxes overlap.
  std::vector<bool> find() {
    std::vector<bool> hit(corners_.size(), false);
    int axis = 0;
    (surface_.points.rowwise().maxCoeff() - surface_.points.rowwise().minCoeff()).maxCoeff(&axis);
    std::vector<std::size_t> order(corners_.size()), active;
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return low_[a][axis] < low_[b][axis]; });
    for (const std::size_t t : order) {
      std::erase_if(active, [&](std::size_t other) { return high_[other][axis] < low_[t][axis]; });
      for (const std::size_t other : active)
        if (overlap(t, other) && cross(t, other)) hit[t] = hit[other] = true;
      active.push_back(t);
    }
    return hit;
  }

 private:
  bool overlap(std::size_t a, std::size_t b) const {
    return (low_[a].array() <= high_[b].array()).all() && (low_[b].array() <= high_[a].array()).all();
  }
  bool cross(std::size_t a, std::size_t b) const {
    const Triangle &s = surface_.triangles[a], &t = surface_.triangles[b];
    const auto shared =
        std::count_if(s.begin(), s.end(), [&](int n) { return std::find(t.begin(), t.end(), n) != t.end(); });
    if (shared >= 2) return false;
    return edges_cross(a, b) || edges_cross(b, a);
  }
  /// An edge of a with a node of b meets b's plane there and nowhere else. It is not asked: in one plane with b,
  /// rounding would decide.
  bool edges_cross(std::size_t a, std::size_t b) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const int first = surface_.triangles[a][i], last = surface_.triangles[a][(i + 1) % 3];
      if (!has_node(b, first) && !has_node(b, last) &&
          passes_through(surface_.points.col(first), surface_.points.col(last), corners_[b]))
        return true;
    }
    return false;
  }
  bool has_node(std::size_t triangle, int node) const {
    const Triangle& t = surface_.triangles[triangle];
    return std::find(t.begin(), t.end(), node) != t.end();
  }

  const TriangleSurface& surface_;
  std::vector<Corners> corners_;
  std::vector<Vec3> low_, high_;
};

}  // namespace

std::vector<bool> self_intersections(const TriangleSurface& surface) {
  return Finder(surface).find();
}

}  // namespace tether
