#include "vessel/centreline/voronoi.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_with_circumcenter_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>

#include <Eigen/LU>
#include <array>
#include <cmath>

namespace tether {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Cell = CGAL::Triangulation_cell_base_with_info_3<int, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_3<Kernel>, Cell>>;

constexpr int outside = -1;

Point point(const Vec3& x) {
  return {x[0], x[1], x[2]};
}
Vec3 vec(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

Mesh mesh_of(const LabelledSurface& surface, bool caps) {
  Mesh mesh;
  for (const auto& x : surface.points.colwise()) mesh.add_vertex(point(x));
  using Vertex = Mesh::Vertex_index;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& n = surface.triangles[t];
    if (caps || surface.label[t] == 0) mesh.add_face(Vertex(n[0]), Vertex(n[1]), Vertex(n[2]));
  }
  return mesh;
}

/// Those of the wall and its rims: spheres may reach out of the openings, where the vessel goes on.
std::vector<Point> wall_points(const LabelledSurface& surface) {
  std::vector<bool> used(static_cast<std::size_t>(surface.points.cols()), false);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (surface.label[t] == 0)
      for (const int n : surface.triangles[t]) used[n] = true;
  std::vector<Point> points;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (used[i]) points.push_back(point(surface.points.col(static_cast<Eigen::Index>(i))));
  return points;
}

/// Of the sphere through four points; not finite where they lie in a plane.
Vec3 centre_of(const std::array<Vec3, 4>& x) {
  Mat3 edges;
  Vec3 half;
  for (int i = 0; i < 3; ++i) {
    const Vec3 edge = x[i + 1] - x[0];
    edges.row(i) = edge;
    half[i] = edge.squaredNorm() / 2;
  }
  return x[0] + edges.inverse() * half;
}

}  // namespace

VoronoiGraph voronoi_graph(const LabelledSurface& surface) {
  const std::vector<Point> points = wall_points(surface);
  Delaunay delaunay(points.begin(), points.end());
  const Mesh mesh = mesh_of(surface, true);
  const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side(mesh);
  VoronoiGraph graph;
  for (const auto cell : delaunay.finite_cell_handles()) {
    cell->info() = outside;
    const auto p = [&](int i) { return cell->vertex(i)->point(); };
    const Vec3 x = centre_of({vec(p(0)), vec(p(1)), vec(p(2)), vec(p(3))});
    if (!x.allFinite() || side(point(x)) != CGAL::ON_BOUNDED_SIDE) continue;
    cell->info() = static_cast<int>(graph.centres.size());
    graph.centres.push_back(x);
    graph.radii.push_back((x - vec(p(0))).norm());
  }
  graph.links.resize(graph.centres.size());
  for (const auto cell : delaunay.finite_cell_handles())
    for (int i = 0; cell->info() != outside && i < 4; ++i) {
      const auto other = cell->neighbor(i);
      if (delaunay.is_infinite(other) || other->info() == outside) continue;
      const int a = cell->info(), b = other->info();
      const double length = (graph.centres[a] - graph.centres[b]).norm();
      graph.links[a].push_back({b, length / std::min(graph.radii[a], graph.radii[b])});
    }
  return graph;
}

struct WallDistance::Tree {
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Mesh>;
  explicit Tree(Mesh wall) : mesh(std::move(wall)), boxes(faces(mesh).first, faces(mesh).second, mesh) {}
  Mesh mesh;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> boxes;
};

WallDistance::WallDistance(const LabelledSurface& surface) : tree_(new Tree(mesh_of(surface, false))) {}
WallDistance::~WallDistance() {
  delete tree_;
}
double WallDistance::operator()(const Vec3& x) const {
  return std::sqrt(tree_->boxes.squared_distance(point(x)));
}

}  // namespace tether
