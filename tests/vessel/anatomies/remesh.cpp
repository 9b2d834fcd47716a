#include "tests/vessel/anatomies/remesh.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

namespace tether {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
namespace pmp = CGAL::Polygon_mesh_processing;

}  // namespace

LabelledSurface remeshed(const LabelledSurface& surface, double edge, int iterations) {
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices;
  for (const auto& x : surface.points.colwise()) vertices.push_back(mesh.add_vertex({x[0], x[1], x[2]}));
  auto label = mesh.add_property_map<Mesh::Face_index, int>("f:label", 0).first;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const auto& t = surface.triangles[i];
    const auto at = [&](int corner) { return vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(corner)])]; };
    label[mesh.add_face(at(0), at(1), at(2))] = surface.label[i];
  }
  auto border = mesh.add_property_map<Mesh::Edge_index, bool>("e:border", false).first;
  for (const auto e : mesh.edges()) {
    const auto h = mesh.halfedge(e);
    border[e] = !mesh.is_border(e) && label[mesh.face(h)] != label[mesh.face(mesh.opposite(h))];
  }
  pmp::isotropic_remeshing(mesh.faces(), edge, mesh,
                           pmp::parameters::number_of_iterations(static_cast<unsigned>(iterations))
                               .edge_is_constrained_map(border)
                               .face_patch_map(label)
                               .number_of_relaxation_steps(3));
  mesh.collect_garbage();
  LabelledSurface result;
  result.openings = surface.openings;
  result.inlet = surface.inlet;
  result.points.resize(3, static_cast<Eigen::Index>(mesh.number_of_vertices()));
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    result.points.col(static_cast<Eigen::Index>(v)) = Vec3(p.x(), p.y(), p.z());
  }
  for (const auto f : mesh.faces()) {
    Triangle t{};
    std::size_t i = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) t[i++] = static_cast<int>(v);
    result.triangles.push_back(t);
    result.label.push_back(label[f]);
  }
  return result;
}

}  // namespace tether
