#include "fluid/section.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <numbers>

#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"
#include "common/mesh/topology.hpp"
#include "fluid/probe.hpp"

namespace tether::fluid {
namespace {

/// Convex; corners in barycentric coordinates of an element.
using Polygon = std::vector<Eigen::Vector4d>;

/// Where a linear function with these values at the nodes of a tetrahedron is zero. Zero counts as positive.
Polygon zero_set(const Eigen::Vector4d& height) {
  std::vector<int> beyond, before;
  for (int a = 0; a < 4; ++a) (height[a] >= 0 ? beyond : before).push_back(a);
  Polygon corners;
  for (std::size_t i = 0; i < beyond.size(); ++i)
    for (std::size_t j = 0; j < before.size(); ++j) {
      const int a = beyond[i], b = before[i % 2 == 0 ? j : before.size() - 1 - j];  // around a quadrilateral
      const double share = height[a] / (height[a] - height[b]);
      corners.push_back((1 - share) * Eigen::Vector4d::Unit(a) + share * Eigen::Vector4d::Unit(b));
    }
  return corners;
}

/// The part where a linear function with these values at the nodes is not negative.
Polygon clipped(const Polygon& polygon, const Eigen::Vector4d& values) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector4d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = values.dot(a), at_b = values.dot(b);
    if (at_a >= 0) result.push_back(a);
    if ((at_a >= 0) != (at_b >= 0)) result.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return result;
}

/// Clipped by a disc about the point: a polygon of 64 sides with the disc's area.
Polygon clipped_by_disc(Polygon polygon, const SectionPlane& plane, const Nodal& corners) {
  constexpr int sides = 64;
  constexpr double step = 2 * std::numbers::pi / sides;
  const double apothem = plane.radius * std::sqrt(step / 2 / std::tan(step / 2));
  const Nodal from_point = corners.colwise() - plane.point;
  const bool is_inside = std::all_of(polygon.begin(), polygon.end(),
                                     [&](const auto& corner) { return (from_point * corner).norm() <= apothem; });
  if (is_inside) return polygon;
  const Vec3 e1 = plane.normal.unitOrthogonal(), e2 = plane.normal.cross(e1);
  for (int k = 0; k < sides && !polygon.empty(); ++k) {
    const Vec3 outward = std::cos(k * step) * e1 + std::sin(k * step) * e2;
    polygon = clipped(polygon, apothem - (from_point.transpose() * outward).array());
  }
  return polygon;
}

struct Part {
  double area = 0;
  Eigen::Vector4d centroid = Eigen::Vector4d::Zero();
};

/// Calls visit(a, b, c) with the corners of triangles that fill the polygon.
template <class Visit>
void for_triangles(const Polygon& polygon, const Visit& visit) {
  for (std::size_t i = 2; i < polygon.size(); ++i) visit(polygon[0], polygon[i - 1], polygon[i]);
}

Part part_of(const Polygon& polygon, const Nodal& corners) {
  Part part;
  for_triangles(polygon, [&](const auto& a, const auto& b, const auto& c) {
    const Vec3 ab = corners * (b - a), ac = corners * (c - a);
    const double area = 0.5 * ab.cross(ac).norm();
    part.area += area;
    part.centroid += area / 3 * (a + b + c);
  });
  if (part.area > 0) part.centroid /= part.area;
  return part;
}

double distance(const Vec3& point, const Polygon& polygon, const Nodal& corners) {
  double least = std::numeric_limits<double>::infinity();
  for_triangles(polygon, [&](const auto& a, const auto& b, const auto& c) {
    Mat3 x;
    x << corners * a, corners * b, corners * c;
    least = std::min(least, (x * closest_in_triangle(point, x.col(0), x.col(1), x.col(2)) - point).norm());
  });
  return least;
}

/// All that the plane cuts within the radius. height: of the nodes over it.
std::vector<CutElement> cut_elements(const FluidMesh& mesh, const Points& points, const VectorXd& height,
                                     const SectionPlane& plane) {
  std::vector<CutElement> result;
  for (std::size_t e = 0; e < mesh.tetrahedra.size(); ++e) {
    const Eigen::Vector4d heights = height(mesh.tetrahedra[e]);
    const auto beyond = (heights.array() >= 0).count();
    if (beyond == 0 || beyond == 4) continue;
    const Nodal corners = gather(points, mesh.tetrahedra[e]);
    const Polygon whole = zero_set(heights), polygon = clipped_by_disc(whole, plane, corners);
    if (polygon.empty()) continue;
    const Part part = part_of(polygon, corners);
    result.push_back({static_cast<int>(e), part.area, part.centroid, heights, polygon != whole,
                      distance(plane.point, polygon, corners)});
  }
  return result;
}

/// An edge of the mesh that the plane crosses, and the place of a cut element in their list.
struct CrossedEdge {
  Edge edge;
  std::size_t place;
  bool operator<(const CrossedEdge& other) const { return edge < other.edge; }
};

Edge sorted_edge(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

/// Sorted by edge.
std::vector<CrossedEdge> crossed_edges(const std::vector<CutElement>& elements, const FluidMesh& mesh) {
  std::vector<CrossedEdge> result;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const Tetrahedron& tet = mesh.tetrahedra[static_cast<std::size_t>(elements[i].element)];
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = a + 1; b < 4; ++b)
        if ((elements[i].height[static_cast<int>(a)] >= 0) != (elements[i].height[static_cast<int>(b)] >= 0))
          result.push_back({sorted_edge(tet[a], tet[b]), i});
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// A part number for each cut element: those that share a crossed edge are in the same part.
std::vector<int> parts_of(const std::vector<CutElement>& elements, const std::vector<CrossedEdge>& edges) {
  std::vector<Tetrahedron> by_edges(elements.size(), {-1, -1, -1, -1});  // numbers of the edges that each one has
  std::vector<std::size_t> filled(elements.size(), 0);
  int count = 0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (i > 0 && edges[i - 1].edge != edges[i].edge) ++count;
    Tetrahedron& own = by_edges[edges[i].place];
    own[filled[edges[i].place]++] = count;
  }
  for (Tetrahedron& own : by_edges)
    if (own[3] < 0) own[3] = own[2];  // a triangle crosses three
  return connected_parts(count + 1, by_edges).part;
}

double distance_to_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a;
  const double length2 = along.squaredNorm(),
               share = length2 > 0 ? std::clamp((point - a).dot(along) / length2, 0.0, 1.0) : 0;
  return (a + share * along - point).norm();
}

/// Throws InputError if the part with these edges meets a triangle of an end within the section's radius.
void check_ends(const std::vector<CrossedEdge>& edges, const FluidMesh& mesh, const Points& points,
                const VectorXd& height, const SectionPlane& plane) {
  const auto leaves_through = [&](const Triangle& t) {
    std::vector<Vec3> crossings;
    for (std::size_t i = 0; i < 3; ++i) {
      const Edge edge = sorted_edge(t[i], t[(i + 1) % 3]);
      if (!std::binary_search(edges.begin(), edges.end(), CrossedEdge{edge, 0})) continue;
      const auto [a, b] = edge;
      crossings.push_back(points.col(a) + height[a] / (height[a] - height[b]) * (points.col(b) - points.col(a)));
    }
    return crossings.size() == 2 && distance_to_segment(plane.point, crossings[0], crossings[1]) < plane.radius;
  };
  for (const auto* patches : {&mesh.inlets, &mesh.outlets})
    for (const Patch& patch : *patches)
      if (std::any_of(patch.triangles.begin(), patch.triangles.end(), leaves_through))
        throw input_error(
            "leaves the lumen through {}: a section must end at the wall; move it, turn it, or give it a radius",
            patch.name);
}

/// (v, grad q) of (F.17).
double flow_of_rows(const SectionCut& cut, const EndOfStep& end) {
  double flow = 0;
  for (const CutElement& c : cut.elements) {
    const auto e = static_cast<std::size_t>(c.element);
    const Tetrahedron& tet = end.domain.mesh().tetrahedra[e];
    const TetGeometry g = tet_geometry(gather(end.points, tet));
    const Vec3 v = gather(end.velocity, tet).rowwise().mean() - end.dt_over_rho * g.grad_N * end.pressure(tet);
    const Vec3 grad_q = g.grad_N * (c.height.array() >= 0).cast<double>().matrix();
    flow += g.volume * v.dot(grad_q);
  }
  return flow;
}

/// <V.n, H - q> over one triangle of Sigma with the area vector n; heights and V of its nodes.
double wall_flow(const Vec3& n, const Vec3& height, const Mat3& V) {
  static const Polygon whole{Eigen::Vector4d::Unit(0), Eigen::Vector4d::Unit(1), Eigen::Vector4d::Unit(2)};
  static const Nodal unit_triangle{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 0}};  // its area is 1/2
  const Part beyond = part_of(clipped(whole, {height[0], height[1], height[2], 0}), unit_triangle);
  const Vec3 through = V.transpose() * n;
  double of_q = 0;
  for (int a = 0; a < 3; ++a)
    if (height[a] >= 0) of_q += (through.sum() + through[a]) / 12;
  return 2 * beyond.area * through.dot(beyond.centroid.head<3>()) - of_q;
}

/// The wall's part of (F.17).
double flow_of_wall(const SectionCut& cut, const EndOfStep& end) {
  const Surface& sigma = end.domain.sigma;
  double flow = 0;
  for (std::size_t t = 0; t < sigma.triangles.size(); ++t) {
    const int element = sigma.tetrahedra[t];
    const auto found = std::lower_bound(cut.elements.begin(), cut.elements.end(), element,
                                        [](const CutElement& c, int e) { return c.element < e; });
    if (found == cut.elements.end() || found->element != element) continue;
    const Tetrahedron& tet = end.domain.mesh().tetrahedra[static_cast<std::size_t>(element)];
    Vec3 height;
    Mat3 V;
    for (int a = 0; a < 3; ++a) {
      const int local = sigma.triangles[t][static_cast<std::size_t>(a)];
      const auto* in_tet = std::find(tet.begin(), tet.end(), sigma.nodes[static_cast<std::size_t>(local)]);
      height[a] = found->height[in_tet - tet.begin()];
      V.col(a) = end.wall_velocity.col(local);
    }
    flow += wall_flow(sigma.area_vectors.col(static_cast<Eigen::Index>(t)), height, V);
  }
  return flow;
}

}  // namespace

Section::Section(std::string name, const SectionPlane& plane) : name_(std::move(name)), plane_(plane) {
  if (!(plane.normal.norm() > 0)) throw InputError("the normal must not be zero");
  if (!(plane.radius > 0)) throw input_error("the radius is {}, but must be positive", plane.radius);
  plane_.normal.normalize();
}

SectionCut Section::cut(const FluidMesh& mesh, const Points& points) const {
  const VectorXd height = (points.colwise() - plane_.point).transpose() * plane_.normal;
  const std::vector<CutElement> all = cut_elements(mesh, points, height, plane_);
  if (all.empty()) throw InputError("its plane misses the lumen");
  const auto nearest = std::min_element(
      all.begin(), all.end(), [](const CutElement& a, const CutElement& b) { return a.distance < b.distance; });
  const std::vector<int> part = parts_of(all, crossed_edges(all, mesh));
  const int own = part[static_cast<std::size_t>(nearest - all.begin())];
  SectionCut result;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (part[i] == own) {
      result.elements.push_back(all[i]);
      result.is_complete = result.is_complete && !all[i].is_clipped;
    }
  check_ends(crossed_edges(result.elements, mesh), mesh, points, height, plane_);
  return result;
}

double Section::mean(const SectionCut& cut, const FluidMesh& mesh, const VectorXd& field) {
  double area = 0, integral = 0;
  for (const CutElement& c : cut.elements) {
    area += c.area;
    integral += c.area * c.centroid.dot(field(mesh.tetrahedra[static_cast<std::size_t>(c.element)]));
  }
  return integral / area;
}

double Section::flow(const SectionCut& cut, const EndOfStep& end) const {
  return cut.is_complete ? flow_of_rows(cut, end) + flow_of_wall(cut, end) : integral_of_velocity(cut, end);
}

double Section::integral_of_velocity(const SectionCut& cut, const EndOfStep& end) const {
  double flow = 0;
  for (const CutElement& c : cut.elements) {
    const auto e = static_cast<std::size_t>(c.element);
    const Tetrahedron& tet = end.domain.mesh().tetrahedra[e];
    const TetGeometry g = tet_geometry(gather(end.points, tet));
    const Vec3 v = gather(end.velocity, tet) * c.centroid - end.dt_over_rho * g.grad_N * end.pressure(tet);
    flow += c.area * plane_.normal.dot(v);
  }
  return flow;
}

Section place_section(const std::string& name, const SectionPlane& plane, const FluidMesh& mesh) {
  Section section(name, plane);
  section.cut(mesh, mesh.points);
  place_probe(name, plane.point, mesh);
  return section;
}

}  // namespace tether::fluid
