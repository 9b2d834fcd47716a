#include "vessel/surface/rims.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "vessel/surface/edges.hpp"

namespace tether {
namespace {

Rim rim_of(const RawSurface& surface, std::vector<int> nodes) {
  Rim rim;
  const Points x = points_at(surface.points, nodes);
  rim.plane = plane_of_loop(x);
  rim.plane.normal *= -1;  // triangles run round a rim the other way than the cap that would close it
  rim.nodes = std::move(nodes);
  for (Eigen::Index i = 0; i < x.cols(); ++i) {
    const Vec3 a = x.col(i) - rim.plane.origin, b = x.col((i + 1) % x.cols()) - rim.plane.origin;
    rim.area -= a.cross(b).dot(rim.plane.normal) / 2;
    rim.off_plane = std::max(rim.off_plane, std::abs(a.dot(rim.plane.normal)));
  }
  return rim;
}

constexpr double nearly_flat =
    0.02;  // of the radius: a projection that changes the opening by less than the image's error

}  // namespace

double Rim::radius() const {
  return std::sqrt(area / std::numbers::pi);
}

std::vector<Rim> rims_of(const RawSurface& surface) {
  std::vector<Rim> rims;
  for (auto& nodes : loops_of(surface.triangles)) rims.push_back(rim_of(surface, std::move(nodes)));
  std::sort(rims.begin(), rims.end(), [](const Rim& a, const Rim& b) { return a.area > b.area; });
  return rims;
}

std::size_t nearest_rim(const std::vector<Rim>& rims, const Vec3& x) {
  const auto distance = [&](const Rim& rim) { return (rim.plane.origin - x).norm(); };
  return static_cast<std::size_t>(
      std::min_element(rims.begin(), rims.end(),
                       [&](const Rim& a, const Rim& b) { return distance(a) < distance(b); }) -
      rims.begin());
}

std::size_t rim_near(const std::vector<Rim>& rims, const Vec3& x, const std::string& field) {
  const std::size_t nearest = nearest_rim(rims, x);
  const Rim& rim = rims[nearest];
  if (const double distance = (rim.plane.origin - x).norm(); distance > 2 * rim.radius())
    throw PlacedError(
        fmt::format("{}: there is no opening near {}: the nearest, at {} with radius {:.3g} cm, is {:.3g} cm away",
                    field, text_of_place(x), text_of_place(rim.plane.origin), rim.radius(), distance),
        {x, rim.plane.origin});
  return nearest;
}

std::vector<Rim> open_labels(RawSurface& surface, const std::vector<int>& ids) {
  const RawSurface closed = surface;
  const std::set<int> caps(ids.begin(), ids.end());
  std::map<Edge, int> id_at;
  std::vector<bool> keep;
  std::vector<int> renumbered(static_cast<std::size_t>(closed.points.cols()), -1);
  int count = 0;
  for (std::size_t t = 0; t < closed.triangles.size(); ++t) {
    keep.push_back(!caps.contains(closed.face_id[t]));
    if (keep.back())
      for (const int n : closed.triangles[t])
        if (renumbered[n] < 0) renumbered[n] = count++;
  }
  for (const int id : ids)
    if (std::find(closed.face_id.begin(), closed.face_id.end(), id) == closed.face_id.end())
      throw input_error("no triangle has the label {}", id);
  for (std::size_t t = 0; t < closed.triangles.size(); ++t)
    if (!keep[t])
      for (std::size_t i = 0; i < 3; ++i) {
        const int a = renumbered[closed.triangles[t][i]], b = renumbered[closed.triangles[t][(i + 1) % 3]];
        if (a >= 0 && b >= 0) id_at[edge_of(a, b)] = closed.face_id[t];
      }
  surface = kept(closed, keep);
  std::vector<Rim> rims = rims_of(surface);
  for (Rim& rim : rims)
    if (const auto id = id_at.find(edge_of(rim.nodes[0], rim.nodes[1])); id != id_at.end()) rim.face_id = id->second;
  return rims;
}

namespace {

/// Triangles with two sides on a rim lie in its plane, once that is flat: they are no part of the wall, and their third
/// side may be an edge of what closes the rim.
void drop_ears(RawSurface& surface) {
  for (bool found = true; found;) {
    std::vector<int> open_sides(surface.triangles.size(), 0);
    for (const auto& [edge, uses] : edges_of(surface.triangles))
      if (uses.size() == 1) ++open_sides[static_cast<std::size_t>(uses.front().triangle)];
    std::vector<bool> keep;
    for (const int count : open_sides) keep.push_back(count < 2);
    found = std::find(keep.begin(), keep.end(), false) != keep.end();
    if (found) surface = kept(surface, keep);
  }
}

}  // namespace

void flatten_rims(Repaired& state) {
  RepairNote moved{RepairKind::rims_flattened}, cut{RepairKind::rims_cut};
  for (const Rim& rim : rims_of(state.surface)) {
    const double r = rim.radius();
    if (rim.off_plane < 1e-6 * r) continue;
    if (rim.off_plane > r)
      throw PlacedError(fmt::format("the rim at {} is as deep as wide ({:.3g} and {:.3g} cm): cut it by a plane",
                                    text_of_place(rim.plane.origin), rim.off_plane, r),
                        {rim.plane.origin});
    const bool move = rim.off_plane < nearly_flat * r;
    RepairNote& note = move ? moved : cut;
    ++note.count, note.place = rim.plane.origin, note.size = std::max(note.size, rim.off_plane);
    if (move)
      for (const int n : rim.nodes) {
        const Vec3 x = state.surface.points.col(n);
        state.surface.points.col(n) = x - rim.plane.normal.dot(x - rim.plane.origin) * rim.plane.normal;
      }
  }
  for (const Rim& first : rims_of(state.surface)) {
    if (first.off_plane < nearly_flat * first.radius()) continue;
    // found again by its place: cutting another rim renumbers nodes
    for (const Rim& rim : rims_of(state.surface)) {
      if ((rim.plane.origin - first.plane.origin).norm() > 1e-9) continue;
      Plane plane = rim.plane;
      plane.origin -= (rim.off_plane + nearly_flat * rim.radius()) * plane.normal;
      cut_off(state.surface, plane);
      break;
    }
  }
  drop_ears(state.surface);
  for (const RepairNote& note : {moved, cut})
    if (note.count > 0) state.notes.push_back(note);
}

}  // namespace tether
