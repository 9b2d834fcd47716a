#include "vessel/surface/remesh.hpp"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>

#include <cmath>
#include <map>

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

void remesh_part(CgalMesh& mesh, const std::vector<CgalMesh::Face_index>& part, double length) {
  PMP::isotropic_remeshing(part, length, mesh,
                           CGAL::parameters::number_of_iterations(rounds).face_patch_map(ids_of(mesh)));
}

/// Parts with edges of one length each; where they meet, triangles stay: a second pass has its borders elsewhere.
void remesh_by_radius(CgalMesh& mesh, const EdgeLength& length, const std::vector<double>& radius) {
  const RadiusAt radius_at(mesh, radius);
  for (const double shift : {0.0, 0.5, 0.0}) {
    std::map<int, std::vector<CgalMesh::Face_index>> parts;
    for (const auto face : mesh.faces()) {
      const auto h = mesh.halfedge(face);
      const auto middle = CGAL::centroid(mesh.point(mesh.source(h)), mesh.point(mesh.target(h)),
                                         mesh.point(mesh.target(mesh.next(h))));
      const double wanted = std::clamp(length.per_radius * radius_at(middle), length.least, length.most);
      parts[static_cast<int>(std::round(std::log(wanted) / std::log(step) + shift))].push_back(face);
    }
    for (const auto& [number, part] : parts)
      remesh_part(mesh, part, std::clamp(std::pow(step, number - shift), length.least, length.most));
    mesh.collect_garbage();
  }
}

}  // namespace

LabelledSurface remeshed(const LabelledSurface& surface, const EdgeLength& length, const std::vector<double>& radius) {
  CgalMesh mesh = cgal_mesh({surface.points, surface.triangles, surface.label});
  if (length.per_radius > 0)
    remesh_by_radius(mesh, length, radius);
  else
    remesh_part(mesh, {mesh.faces().begin(), mesh.faces().end()}, length.most);
  RawSurface made = raw_surface(mesh);
  return {std::move(made.points), std::move(made.triangles), std::move(made.face_id), surface.openings, surface.inlet};
}

}  // namespace tether
