#include "observation_manager/measurements/self_intersection.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/box_intersection_d.h>

#include <Eigen/Geometry>
#include <algorithm>

namespace tether {
namespace {

using CornerColumns = Eigen::Matrix3d;  ///< one column a corner

/// Whether the segment p q passes through the inside of the triangle (Moeller and Trumbore 1997).
bool passes_through(const Vec3& p, const Vec3& q, const CornerColumns& t) {
  constexpr double inside = 1e-9;
  const Vec3 way = q - p, e1 = t.col(1) - t.col(0), e2 = t.col(2) - t.col(0), across = way.cross(e2);
  const double determinant = e1.dot(across);
  if (std::abs(determinant) <= 1e-12 * way.norm() * e1.norm() * e2.norm()) return false;
  const Vec3 from = p - t.col(0), turned = from.cross(e1);
  const double u = from.dot(across) / determinant, v = way.dot(turned) / determinant, at = e2.dot(turned) / determinant;
  return u > inside && v > inside && u + v < 1 - inside && at > inside && at < 1 - inside;
}

/// Boxes that are compared in a row instead of in a tree: least time for lumen surfaces of 50,000 triangles.
constexpr std::ptrdiff_t scan_below = 400;

using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;

class Finder {
 public:
  explicit Finder(const TriangleSurface& surface) : surface_(surface) {
    for (const Triangle& t : surface.triangles) {
      const CornerColumns& corners = corners_.emplace_back(surface.points(Eigen::all, t));
      normals_.emplace_back((corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)));
    }
  }

  /// Compares triangles whose boxes overlap (Zomorodian and Edelsbrunner 2002, of CGAL).
  std::vector<bool> find() const {
    std::vector<bool> hit(corners_.size(), false);
    const std::vector<Box> boxes = this->boxes();
    std::vector<const Box*> order;  // to sort pointers is cheaper
    for (const Box& box : boxes) order.push_back(&box);
    CGAL::box_self_intersection_d(
        order.begin(), order.end(),
        [&](const Box* one, const Box* other) {
          const std::size_t a = one->info(), b = other->info();
          if (cross(a, b)) hit[a] = hit[b] = true;
        },
        scan_below);
    return hit;
  }

 private:
  std::vector<Box> boxes() const {
    std::vector<Box> boxes;
    for (std::size_t t = 0; t < corners_.size(); ++t) {
      const Vec3 low = corners_[t].rowwise().minCoeff(), high = corners_[t].rowwise().maxCoeff();
      boxes.emplace_back(CGAL::Bbox_3(low[0], low[1], low[2], high[0], high[1], high[2]), t);
    }
    return boxes;
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
      if (!has_node(b, first) && !has_node(b, last) && on_two_sides(first, last, b) &&
          passes_through(surface_.points.col(first), surface_.points.col(last), corners_[b]))
        return true;
    }
    return false;
  }
  bool on_two_sides(int one, int other, std::size_t of) const {
    const auto above = [&](int node) { return normals_[of].dot(surface_.points.col(node) - corners_[of].col(0)); };
    return above(one) * above(other) < 0;
  }
  bool has_node(std::size_t triangle, int node) const {
    const Triangle& t = surface_.triangles[triangle];
    return std::find(t.begin(), t.end(), node) != t.end();
  }

  const TriangleSurface& surface_;
  std::vector<CornerColumns> corners_;
  std::vector<Vec3> normals_;  ///< of any length
};

}  // namespace

std::vector<bool> self_intersections(const TriangleSurface& surface) {
  return Finder(surface).find();
}

}  // namespace tether
