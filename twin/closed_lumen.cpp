#include "twin/closed_lumen.hpp"

#include <Eigen/Geometry>
#include <map>

#include "common/mesh/surface.hpp"
#include "common/mesh/topology.hpp"
#include "twin/random.hpp"

namespace tether {
namespace {

/// Points and triangles under construction.
struct Growing {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;

  int add(const Vec3& x) {
    points.push_back(x);
    return static_cast<int>(points.size()) - 1;
  }
  TriangleSurface surface() const {
    TriangleSurface result{Points(3, static_cast<Eigen::Index>(points.size())), triangles};
    for (std::size_t i = 0; i < points.size(); ++i) result.points.col(static_cast<Eigen::Index>(i)) = points[i];
    return result;
  }
};

Growing growing(const TriangleSurface& surface) {
  Growing result;
  for (const auto& x : surface.points.colwise()) result.points.emplace_back(x);
  result.triangles = surface.triangles;
  return result;
}

/// The way out of the vessel at an end: the area vector of the closing face, which with the others adds up to zero.
Vec3 outward_normal(const std::vector<int>& rim, const std::vector<Vec3>& points) {
  Vec3 area = Vec3::Zero();
  for (std::size_t i = 0; i < rim.size(); ++i)
    area += points[static_cast<std::size_t>(rim[i])].cross(points[static_cast<std::size_t>(rim[(i + 1) % rim.size()])]);
  return -area.normalized();
}

/// Draws one end out and closes it with a fan.
void close_end(Growing& surface, const std::vector<int>& rim, double margin) {
  const Vec3 way = margin * outward_normal(rim, surface.points);
  std::vector<int> moved;
  Vec3 middle = Vec3::Zero();
  for (const int node : rim) {
    moved.push_back(surface.add(surface.points[static_cast<std::size_t>(node)] + way));
    middle += surface.points.back() / static_cast<double>(rim.size());
  }
  const int centre = surface.add(middle);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const std::size_t j = (i + 1) % rim.size();
    surface.triangles.push_back({rim[j], rim[i], moved[i]});
    surface.triangles.push_back({rim[j], moved[i], moved[j]});
    surface.triangles.push_back({moved[j], moved[i], centre});
  }
}

/// At a share of the way along an edge's curve (T.4).
Vec3 on_curve(const Points& x, const Points& normals, const Edge& edge, double share) {
  const Vec3 a = x.col(edge[0]), b = x.col(edge[1]), way = b - a;
  const Vec3 after_a = a + (way - way.dot(normals.col(edge[0])) * normals.col(edge[0])) / 3;
  const Vec3 before_b = b - (way - way.dot(normals.col(edge[1])) * normals.col(edge[1])) / 3;
  const double s = share, t = 1 - share;
  return t * t * t * a + 3 * t * t * s * after_a + 3 * t * s * s * before_b + s * s * s * b;
}

}  // namespace

TriangleSurface closed_lumen(const TriangleSurface& lumen, double margin) {
  Growing surface = growing(lumen);
  for (const auto& rim : rims(lumen.triangles)) close_end(surface, rim, margin);
  return surface.surface();
}

TriangleSurface rounded(const TriangleSurface& surface, std::uint64_t seed) {
  const Points normals = nodal_normals(surface.points, surface.triangles);
  Random random(seed, 0);
  Growing fine = growing(surface);
  fine.triangles.clear();
  std::map<Edge, int> between;
  const auto middle = [&](int a, int b) {
    const Edge edge{std::min(a, b), std::max(a, b)};
    const auto [known, is_new] = between.emplace(edge, 0);
    if (is_new) known->second = fine.add(on_curve(surface.points, normals, edge, 0.3 + 0.4 * random.uniform()));
    return known->second;
  };
  for (const auto& [a, b, c] : surface.triangles) {
    const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const Triangle& t : {Triangle{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) fine.triangles.push_back(t);
  }
  return fine.surface();
}

}  // namespace tether
