#include "vessel/anatomy/geodesic.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>
#include <vector>

#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"

namespace tether {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using ShortestPaths = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>>;

double mean_edge(const TriangleLocator& surface) {
  double sum = 0;
  for (const Triangle& t : surface.triangles()) sum += (surface.points().col(t[1]) - surface.points().col(t[0])).norm();
  return sum / static_cast<double>(surface.triangles().size());
}

/// Points of the curve at most so far apart.
std::vector<Vec3> sampled(const Points& curve, double spacing) {
  std::vector<Vec3> samples{curve.col(0)};
  for (Eigen::Index i = 1; i < curve.cols(); ++i) {
    const Vec3 way = curve.col(i) - samples.back();
    if (i + 1 < curve.cols() && way.norm() < spacing / 2) continue;
    const Vec3 from = samples.back();
    const int steps = std::max(1, static_cast<int>(std::ceil(way.norm() / spacing)));
    for (int step = 1; step <= steps; ++step) samples.emplace_back(from + way * step / steps);
  }
  return samples;
}

/// Where the smooth surface's normal points to x. The nearest place of the triangles is at their edges and corners too
/// often: an error of the first order in their size if x is off the surface.
TriangleLocator::Nearest foot_of(const Vec3& x, const TriangleLocator& surface, const Points& normals) {
  const auto sideways = [&](const TriangleLocator::Nearest& at) -> Vec3 {
    const Triangle& t = surface.triangles()[static_cast<std::size_t>(at.triangle)];
    const Vec3 normal = (normals(Eigen::all, t) * at.barycentric).normalized(), arm = x - at.place;
    return arm - normal * normal.dot(arm);
  };
  TriangleLocator::Nearest best = surface.nearest(x);
  double step = 1;
  for (int i = 0; i < 40 && step > 1e-3; ++i) {
    const TriangleLocator::Nearest next = surface.nearest(best.place + step * sideways(best));
    if (sideways(next).norm() < sideways(best).norm())
      best = next;
    else
      step /= 2;
  }
  return best;
}

/// The part of the surface on which paths of a length can run, as CGAL has it.
struct Neighbourhood {
  Mesh mesh;
  std::unordered_map<int, Mesh::Face_index> face_of;      ///< by triangle
  std::unordered_map<int, Mesh::Vertex_index> vertex_of;  ///< by node
};

Neighbourhood neighbourhood(const TriangleLocator& surface, const Vec3& centre, double radius) {
  Neighbourhood near;
  const auto vertex = [&](int node) {
    const auto [known, is_new] = near.vertex_of.try_emplace(node);
    if (is_new) {
      const Vec3 x = surface.points().col(node);
      known->second = near.mesh.add_vertex({x[0], x[1], x[2]});
    }
    return known->second;
  };
  surface.overlapping(centre.array() - radius, centre.array() + radius, [&](int triangle) {
    const Triangle& t = surface.triangles()[static_cast<std::size_t>(triangle)];
    near.face_of[triangle] = near.mesh.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2]));
  });
  return near;
}

/// Distance from a corner of a flat triangle to the opposite side, of which the ends are so far away.
double distance_to_side(double to_one, double to_other, double side) {
  const double along = (to_one * to_one - to_other * to_other + side * side) / (2 * side);
  if (along <= 0 || along >= side) return std::min(to_one, to_other);
  return std::sqrt(std::max(0.0, to_one * to_one - along * along));
}

/// Distances from one place of the surface.
class FromPlace {
 public:
  FromPlace(const TriangleLocator& surface, const TriangleLocator::Nearest& foot, double within)
      : surface_(surface), foot_(foot), near_(neighbourhood(surface, foot.place, within)), paths_(near_.mesh) {
    paths_.add_source_point(location(foot.triangle, foot.barycentric));
  }

  /// None: farther than `within`, or not connected.
  std::optional<double> to(int triangle, const Vec3& barycentric) {
    if (!near_.face_of.contains(triangle)) return {};
    const auto [face, weights] = location(triangle, barycentric);
    const double distance = paths_.shortest_distance_to_source_points(face, weights).first;
    return distance >= 0 ? std::optional(distance) : std::nullopt;
  }
  std::optional<double> to(const FromPlace& other) { return to(other.foot_.triangle, other.foot_.barycentric); }
  const Vec3& place() const { return foot_.place; }

 private:
  ShortestPaths::Face_location location(int triangle, const Vec3& weights) const {
    const auto face = near_.face_of.at(triangle);
    const Triangle& nodes = surface_.triangles()[static_cast<std::size_t>(triangle)];
    const auto begin = near_.mesh.halfedge(face);  // CGAL's face begins at a corner of its own choice
    const std::array corners{near_.mesh.source(begin), near_.mesh.target(begin),
                             near_.mesh.target(near_.mesh.next(begin))};
    std::array<double, 3> turned{};
    for (std::size_t place = 0; place < 3; ++place)
      for (std::size_t i = 0; i < 3; ++i)
        if (near_.vertex_of.at(nodes[i]) == corners[place]) turned[place] = weights[static_cast<Eigen::Index>(i)];
    return {face, {{turned[0], turned[1], turned[2]}}};
  }

  const TriangleLocator& surface_;
  TriangleLocator::Nearest foot_;
  Neighbourhood near_;
  ShortestPaths paths_;
};

}  // namespace

struct GeodesicDistance::Paths {
  const TriangleLocator& surface;
  double within;
  std::vector<std::unique_ptr<FromPlace>> from;
  std::vector<double> sides;  ///< from each place to the next
};

GeodesicDistance::GeodesicDistance(const TriangleLocator& surface, const Points& curve, double within)
    : paths_(new Paths{surface, within, {}, {}}) {
  if (curve.cols() == 0) throw input_error("a region near a curve: the curve has no points");
  const double spacing = std::clamp(1.5 * mean_edge(surface), 0.05 * within, 0.3 * within);
  const Points normals = nodal_normals(surface.points(), surface.triangles());
  for (const Vec3& sample : sampled(curve, spacing)) {
    const TriangleLocator::Nearest foot = foot_of(sample, surface, normals);
    if (!paths_->from.empty() && (paths_->from.back()->place() - foot.place).norm() < 1e-3 * spacing) continue;
    paths_->from.push_back(std::make_unique<FromPlace>(surface, foot, 1.2 * within));
  }
  for (std::size_t i = 0; i + 1 < paths_->from.size(); ++i) {
    FromPlace &here = *paths_->from[i], &next = *paths_->from[i + 1];
    paths_->sides.push_back(here.to(next).value_or((here.place() - next.place()).norm()));
  }
}
GeodesicDistance::~GeodesicDistance() = default;

double GeodesicDistance::at(int triangle, const Vec3& barycentric) const {
  const Vec3 x = paths_->surface.points()(Eigen::all, paths_->surface.triangles()[static_cast<std::size_t>(triangle)]) *
                 barycentric;
  double least = std::numeric_limits<double>::infinity(), straight = least;
  std::optional<double> before;
  for (std::size_t i = 0; i < paths_->from.size(); ++i) {
    const double direct = (paths_->from[i]->place() - x).norm();
    straight = std::min(straight, direct);
    const std::optional<double> here =
        direct < 1.2 * paths_->within ? paths_->from[i]->to(triangle, barycentric) : std::nullopt;
    if (here) least = std::min(least, before ? distance_to_side(*before, *here, paths_->sides[i - 1]) : *here);
    before = here;
  }
  return std::isfinite(least) ? least : std::max(paths_->within, straight);
}

}  // namespace tether
