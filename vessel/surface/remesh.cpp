#include "vessel/surface/remesh.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/compute_normal.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "common/mesh/surface.hpp"
#include "vessel/surface/cgal_mesh.ipp"

namespace tether {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

constexpr unsigned rounds = 5;
constexpr double step = 1.3;  // between neighbouring edge lengths: below the range that remeshing leaves anyway

/// The radius that belongs to places on a surface.
class RadiusAt {
 public:
  RadiusAt(const CgalMesh& mesh, const std::vector<double>& radius)
      : mesh_(mesh), radius_(radius), tree_(faces(mesh_).first, faces(mesh_).second, mesh_) {}
  double operator()(const Kernel::Point_3& x) const {
    const auto face = tree_.closest_point_and_primitive(x).second;
    double sum = 0;
    for (const auto v : mesh_.vertices_around_face(mesh_.halfedge(face))) sum += radius_[v.idx()] / 3;
    return sum;
  }

 private:
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<CgalMesh>;
  CgalMesh mesh_;
  const std::vector<double>& radius_;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree_;
};

/// The lumen's wall as it was given. CGAL projects what it remeshes onto what it was called with: each further pass, of
/// another part, lays its nodes onto the facets of the pass before, and a round vessel becomes thinner.
class GivenWall {
 public:
  explicit GivenWall(CgalMesh mesh) : mesh_(std::move(mesh)) {
    const FaceNumbers ids = ids_of(mesh_);
    std::vector<CgalMesh::Face_index> wall;
    for (const auto face : mesh_.faces())
      if (ids[face] == 0) wall.push_back(face);
    tree_.insert(wall.begin(), wall.end(), mesh_);
  }
  /// Lays nodes that came to lie inside the wall onto it, but those of rims. Those outside stay: where two vessels part
  /// they round the edge, and a wall needs that to have room there.
  void take_back(CgalMesh& mesh) const {
    const FaceNumbers ids = ids_of(mesh);
    std::vector<std::pair<CgalMesh::Vertex_index, Kernel::Point_3>> moves;
    for (const auto v : mesh.vertices()) {
      const auto around = mesh.faces_around_target(mesh.halfedge(v));
      if (std::any_of(around.begin(), around.end(), [&](CgalMesh::Face_index face) { return ids[face] != 0; }))
        continue;
      const Kernel::Point_3 place = tree_.closest_point(mesh.point(v));
      if (PMP::compute_vertex_normal(v, mesh) * (place - mesh.point(v)) > 0) moves.emplace_back(v, place);
    }
    for (const auto& [v, place] : moves) mesh.point(v) = place;
  }

 private:
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<CgalMesh>;
  CgalMesh mesh_;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree_;
};

void remesh_part(CgalMesh& mesh, const std::vector<CgalMesh::Face_index>& part, double length) {
  PMP::isotropic_remeshing(part, length, mesh,
                           CGAL::parameters::number_of_iterations(rounds).face_patch_map(ids_of(mesh)));
}

std::array<Vec3, 3> corners_of(const CgalMesh& mesh, CgalMesh::Face_index face) {
  const auto h = mesh.halfedge(face);
  return {vec_of(mesh.point(mesh.source(h))), vec_of(mesh.point(mesh.target(h))),
          vec_of(mesh.point(mesh.target(mesh.next(h))))};
}

/// Which cap a triangle is of, by its plane: CGAL gives none to a triangle beside a part that it splits.
class CapAt {
 public:
  explicit CapAt(const LabelledSurface& surface) {
    for (int label = 1; label <= static_cast<int>(surface.openings.size()); ++label) {
      std::vector<Triangle> cap;
      for (std::size_t t = 0; t < surface.triangles.size(); ++t)
        if (surface.label[t] == label) cap.push_back(surface.triangles[t]);
      const Vec3 middle = centroid(surface.points, cap);
      double reach = 0;
      for (const Triangle& t : cap)
        for (const int n : t) reach = std::max(reach, (surface.points.col(n) - middle).norm());
      caps_.push_back({{middle, total_area_vector(surface.points, cap).normalized()}, reach});
    }
  }
  int operator()(const std::array<Vec3, 3>& corners) const {
    for (std::size_t k = 0; k < caps_.size(); ++k)
      if (std::all_of(corners.begin(), corners.end(), [&](const Vec3& x) { return is_on(caps_[k], x); }))
        return static_cast<int>(k) + 1;
    return 0;
  }
  /// The radius of the cap beside which a place is: a part's border that met a rim would bend it.
  std::optional<double> radius_beside(const Vec3& x) const {
    for (const Cap& cap : caps_)
      if ((x - cap.plane.origin).norm() < 1.5 * cap.reach) return cap.reach;
    return std::nullopt;
  }
  /// Throws InputError if a triangle of a cap left its plane.
  void check(const CgalMesh& mesh, const FaceNumbers& ids) const {
    for (const auto face : mesh.faces())
      if (ids[face] > 0 && (*this)(corners_of(mesh, face)) != ids[face])
        throw input_error("the rim at {} was bent by new triangles: try edges.per_radius: 0",
                          text_of_place(caps_[static_cast<std::size_t>(ids[face]) - 1].plane.origin));
  }

 private:
  struct Cap {
    Plane plane;
    double reach;
  };
  static constexpr double flat = 1e-4;  // files have single precision, some 1e-6 of the radius; an edge is far longer
  static bool is_on(const Cap& cap, const Vec3& x) {
    const Vec3 from = x - cap.plane.origin;
    return std::abs(from.dot(cap.plane.normal)) < flat * cap.reach && from.norm() < 1.01 * cap.reach;
  }
  std::vector<Cap> caps_;
};

/// Parts with edges of one length each. A part's border is split and collapsed as the part wants it, which changes
/// triangles beside it: parts are found anew each time. Three passes, with borders at other places; `first`: of which,
/// as a share of a step.
void remesh_by_radius(CgalMesh& mesh, const EdgeLength& length, const std::vector<double>& radius, const CapAt& cap_at,
                      double first) {
  const RadiusAt radius_at(mesh, radius);
  // first all alike and fine: parts of the slivers that cuts leave have borders on which CGAL's remeshing fails
  remesh_part(mesh, {mesh.faces().begin(), mesh.faces().end()}, length.least);
  mesh.collect_garbage();
  FaceNumbers ids = ids_of(mesh);
  for (const double shift : {first, first + 0.5, first}) {
    const auto part_of = [&](CgalMesh::Face_index face) {
      const auto x = corners_of(mesh, face);
      const Vec3 middle = (x[0] + x[1] + x[2]) / 3;
      const double r = cap_at.radius_beside(middle).value_or(radius_at({middle[0], middle[1], middle[2]}));
      const double wanted = std::clamp(length.per_radius * r, length.least, length.most);
      return static_cast<int>(std::round(std::log(wanted) / std::log(step) + shift));
    };
    std::set<int> numbers;
    for (const auto face : mesh.faces()) numbers.insert(part_of(face));
    for (const int number : numbers) {
      std::vector<CgalMesh::Face_index> part;
      for (const auto face : mesh.faces())
        if (part_of(face) == number) part.push_back(face);
      remesh_part(mesh, part, std::clamp(std::pow(step, number - shift), length.least, length.most));
      mesh.collect_garbage();
      for (const auto face : mesh.faces())
        if (ids[face] == no_id) ids[face] = cap_at(corners_of(mesh, face));
    }
  }
}

/// On some borders of parts CGAL's remeshing stops at an assertion; where they lie is a matter of choice.
CgalMesh remeshed_by_radius(const CgalMesh& surface, const EdgeLength& length, const std::vector<double>& radius,
                            const CapAt& cap_at) {
  constexpr double last = 0.75;
  for (double first = 0;; first += 0.25) try {
      CgalMesh mesh = surface;
      remesh_by_radius(mesh, length, radius, cap_at, first);
      return mesh;
    } catch (const CGAL::Failure_exception&) {
      if (first >= last) throw;
    }
}

/// Beside the borders of parts some triangles stay caps and needles, which neither a wall nor tetrahedra can stand on:
/// caps are flipped, needles collapsed. Rims stay as they are.
void remove_slivers(CgalMesh& mesh, double edge) {
  constexpr double widest_angle = -0.866;  // the cosine of 150 degrees
  constexpr double longest_to_shortest = 5, shortest = 0.3;
  const FaceNumbers ids = ids_of(mesh);
  auto rim = mesh.add_property_map<CgalMesh::Edge_index, bool>("e:rim", false).first;
  auto on_rim = mesh.add_property_map<CgalMesh::Vertex_index, bool>("v:rim", false).first;
  for (const auto e : mesh.edges()) {
    const auto h = mesh.halfedge(e);
    rim[e] = ids[mesh.face(h)] != ids[mesh.face(mesh.opposite(h))];
    if (rim[e]) on_rim[mesh.source(h)] = on_rim[mesh.target(h)] = true;
  }
  PMP::experimental::remove_almost_degenerate_faces(
      mesh, widest_angle, longest_to_shortest, shortest * edge,
      CGAL::parameters::edge_is_constrained_map(rim).vertex_is_constrained_map(on_rim));
  mesh.collect_garbage();
}

}  // namespace

LabelledSurface remeshed(const LabelledSurface& surface, const EdgeLength& length, const std::vector<double>& radius) {
  CgalMesh mesh = cgal_mesh({surface.points, surface.triangles, surface.label});
  const GivenWall given(mesh);
  try {
    if (length.per_radius > 0)
      mesh = remeshed_by_radius(mesh, length, radius, CapAt(surface));
    else
      remesh_part(mesh, {mesh.faces().begin(), mesh.faces().end()}, length.most);
    remove_slivers(mesh, length.per_radius > 0 ? length.least : length.most);
    if (length.per_radius > 0) given.take_back(mesh);
  } catch (const CGAL::Failure_exception& failure) {
    throw input_error(
        "no triangles with edges of these lengths can be made (CGAL: {}): try other edges, or "
        "edges.per_radius: 0",
        failure.expression());
  }
  CapAt(surface).check(mesh, ids_of(mesh));
  RawSurface made = raw_surface(mesh);
  return {std::move(made.points), std::move(made.triangles), std::move(made.face_id), surface.openings, surface.inlet};
}

}  // namespace tether
