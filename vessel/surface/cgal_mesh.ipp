// CGAL's mesh of a surface and back: for sources only, they alone include CGAL.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "vessel/surface/raw_surface.hpp"

namespace tether {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using FaceNumbers = CgalMesh::Property_map<CgalMesh::Face_index, int>;

inline constexpr int no_id = -1;  ///< of triangles that CGAL makes

inline FaceNumbers ids_of(CgalMesh& mesh) {
  return mesh.add_property_map<CgalMesh::Face_index, int>("f:id", no_id).first;
}

inline CgalMesh cgal_mesh(const RawSurface& surface) {
  CgalMesh mesh;
  FaceNumbers ids = ids_of(mesh);
  for (const auto& x : surface.points.colwise()) mesh.add_vertex({x[0], x[1], x[2]});
  using Vertex = CgalMesh::Vertex_index;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& n = surface.triangles[t];
    const auto face = mesh.add_face(Vertex(n[0]), Vertex(n[1]), Vertex(n[2]));
    if (face == CgalMesh::null_face())
      throw PlacedError("the surface folds onto itself at " + text_of_place(surface.points.col(n[0])),
                        {surface.points.col(n[0])});
    ids[face] = surface.face_id[t];
  }
  return mesh;
}

inline Vec3 vec_of(const Kernel::Point_3& p) {
  return {p.x(), p.y(), p.z()};
}

inline RawSurface raw_surface(CgalMesh& mesh) {
  mesh.collect_garbage();
  const FaceNumbers ids = ids_of(mesh);
  RawSurface surface;
  surface.points.resize(3, static_cast<Eigen::Index>(mesh.number_of_vertices()));
  for (const auto v : mesh.vertices()) surface.points.col(static_cast<Eigen::Index>(v.idx())) = vec_of(mesh.point(v));
  for (const auto f : mesh.faces()) {
    Triangle triangle;
    std::size_t i = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) triangle[i++] = static_cast<int>(v.idx());
    surface.triangles.push_back(triangle);
    surface.face_id.push_back(ids[f]);
  }
  return surface;
}

}  // namespace tether
