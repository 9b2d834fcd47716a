#include "vessel/surface/crossings.hpp"

#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/repair_self_intersections.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <set>

#include "common/mesh/surface.hpp"
#include "vessel/surface/cgal_mesh.ipp"
#include "vessel/surface/edges.hpp"

namespace tether {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;

constexpr double most_crossing = 0.05;  // of the area: more is not a flaw but another shape

std::set<CgalMesh::Face_index> crossing_faces(const CgalMesh& mesh) {
  std::vector<std::pair<CgalMesh::Face_index, CgalMesh::Face_index>> pairs;
  PMP::self_intersections(mesh, std::back_inserter(pairs));
  std::set<CgalMesh::Face_index> faces;
  for (const auto& [a, b] : pairs) faces.insert({a, b});
  return faces;
}

/// New triangles take the id that most of their neighbours have.
void spread_ids(RawSurface& surface) {
  const EdgeUses edges = edges_of(surface.triangles);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [edge, uses] : edges) {
      if (uses.size() != 2) continue;
      int &a = surface.face_id[uses[0].triangle], &b = surface.face_id[uses[1].triangle];
      if ((a == no_id) == (b == no_id)) continue;
      (a == no_id ? a : b) = std::max(a, b);
      changed = true;
    }
  }
  for (int& id : surface.face_id) id = std::max(id, 0);
}

std::vector<std::size_t> crossing_triangles(const RawSurface& surface) {
  std::vector<std::size_t> found;
  for (const auto face : crossing_faces(cgal_mesh(surface))) found.push_back(face.idx());
  return found;
}

}  // namespace

std::vector<Vec3> crossings_of(const RawSurface& surface) {
  std::vector<Vec3> places;
  for (const std::size_t t : crossing_triangles(surface)) places.push_back(middle(surface, t));
  return places;
}

void remove_slivers(Repaired& state, double length) {
  CgalMesh mesh = cgal_mesh(state.surface);
  const std::size_t before = mesh.number_of_faces();
  constexpr double widest_angle = -0.985;  // the cosine of 170 degrees
  constexpr double longest_to_shortest = 20;
  PMP::remove_degenerate_faces(mesh);
  PMP::experimental::remove_almost_degenerate_faces(mesh, widest_angle, longest_to_shortest, length);
  RawSurface mended = raw_surface(mesh);
  if (mended.triangles.size() == before) return;
  spread_ids(mended);
  std::set<std::array<double, 3>> left;
  for (const auto& x : mended.points.colwise()) left.insert({x[0], x[1], x[2]});
  RepairNote note{RepairKind::slivers_removed, static_cast<int>(before) - static_cast<int>(mended.triangles.size())};
  for (const auto& x : state.surface.points.colwise())
    if (!left.contains({x[0], x[1], x[2]})) note.place = x;
  state.surface = std::move(mended);
  state.notes.push_back(note);
}

void remove_crossings(Repaired& state) {
  const std::vector<std::size_t> crossing = crossing_triangles(state.surface);
  if (crossing.empty()) return;
  RepairNote note{RepairKind::crossings_removed, static_cast<int>(crossing.size())};
  std::vector<Vec3> places;
  for (const std::size_t t : crossing) {
    note.size += area_vector(state.surface.points, state.surface.triangles[t]).norm();
    places.push_back(middle(state.surface, t));
  }
  note.place = places.front();
  const double whole = total_area(state.surface.points, state.surface.triangles);
  if (note.size > most_crossing * whole)
    throw PlacedError(fmt::format("{} triangles, {:.0f} % of the area, cross others, the first at {}: too many to mend",
                                  crossing.size(), 100 * note.size / whole, text_of_place(note.place)),
                      places);
  CgalMesh mesh = cgal_mesh(state.surface);
  PMP::experimental::remove_self_intersections(mesh);
  state.surface = raw_surface(mesh);
  spread_ids(state.surface);
  if (const std::vector<Vec3> left = crossings_of(state.surface); !left.empty())
    throw PlacedError(fmt::format("{} triangles cross others and cannot be mended, the first at {}", left.size(),
                                  text_of_place(left.front())),
                      left);
  state.notes.push_back(note);
}

}  // namespace tether
