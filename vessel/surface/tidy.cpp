#include "vessel/surface/tidy.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <queue>
#include <set>

#include "common/mesh/surface.hpp"
#include "vessel/surface/edges.hpp"

namespace tether {
namespace {

using Cell = std::array<std::int64_t, 3>;

/// For each point the first within the tolerance.
std::vector<int> first_at_place(const Points& points, double tolerance) {
  std::map<Cell, std::vector<int>> cells;
  std::vector<int> first(static_cast<std::size_t>(points.cols()));
  const auto find = [&](int i, const Cell& home) {
    for (int k = 0; k < 27; ++k) {
      const auto there = cells.find({home[0] + k % 3 - 1, home[1] + k / 3 % 3 - 1, home[2] + k / 9 - 1});
      if (there == cells.end()) continue;
      for (const int j : there->second)
        if ((points.col(i) - points.col(j)).norm() <= tolerance) return j;
    }
    return -1;
  };
  for (int i = 0; i < static_cast<int>(first.size()); ++i) {
    Cell home;
    for (int c = 0; c < 3; ++c) home[c] = static_cast<std::int64_t>(std::floor(points(c, i) / tolerance));
    const int same = find(i, home);
    first[i] = same < 0 ? i : same;
    if (same < 0) cells[home].push_back(i);
  }
  return first;
}

void drop(Repaired& state, const std::vector<bool>& keep, RepairKind kind, int count) {
  RepairNote note{kind, count};
  for (std::size_t t = 0; t < keep.size(); ++t) {
    if (keep[t]) continue;
    note.place = middle(state.surface, t);
    note.size += area_vector(state.surface.points, state.surface.triangles[t]).norm();
  }
  state.surface = kept(state.surface, keep);
  state.notes.push_back(note);
}

std::vector<double> areas_by(const RawSurface& surface, const std::vector<int>& patch) {
  std::vector<double> areas(patch.empty() ? 0 : *std::max_element(patch.begin(), patch.end()) + 1, 0.0);
  for (std::size_t t = 0; t < patch.size(); ++t)
    areas[patch[t]] += area_vector(surface.points, surface.triangles[t]).norm();
  return areas;
}

constexpr double largest_fin = 0.1;  // of the whole area: larger, it is a wall of its own

/// Triangles at each point.
std::vector<std::vector<int>> fans_of(const RawSurface& surface) {
  std::vector<std::vector<int>> at(static_cast<std::size_t>(surface.points.cols()));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (const int n : surface.triangles[t]) at[n].push_back(static_cast<int>(t));
  return at;
}

bool share_edge(const Triangle& a, const Triangle& b) {
  int common = 0;
  for (const int n : a) common += std::find(b.begin(), b.end(), n) != b.end();
  return common >= 2;
}

/// The triangles at a point that hang together with its first one.
std::vector<int> first_fan(const RawSurface& surface, const std::vector<int>& around) {
  std::vector<int> fan{around.front()};
  for (std::size_t i = 0; i < fan.size(); ++i)
    for (const int t : around)
      if (std::find(fan.begin(), fan.end(), t) == fan.end() &&
          share_edge(surface.triangles[fan[i]], surface.triangles[t]))
        fan.push_back(t);
  return fan;
}

/// Whether each triangle is to be turned to look the same way as the first.
std::vector<bool> turned_alike(const RawSurface& surface) {
  const EdgeUses edges = edges_of(surface.triangles);
  std::vector<int> side(surface.triangles.size(), 0);
  side[0] = 1;
  std::queue<int> open({0});
  while (!open.empty()) {
    const int t = open.front();
    open.pop();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& uses = edges.at(edge_of(surface.triangles[t][i], surface.triangles[t][(i + 1) % 3]));
      if (uses.size() != 2) continue;
      const int other = uses[uses[0].triangle == t].triangle;
      const int wanted = uses[0].from == uses[1].from ? -side[t] : side[t];
      if (side[other] == 0) side[other] = wanted, open.push(other);
      if (side[other] != wanted)
        throw PlacedError(fmt::format("the surface has but one side, as a Moebius strip: seen at {}",
                                      text_of_place(middle(surface, static_cast<std::size_t>(other)))),
                          {middle(surface, static_cast<std::size_t>(other))});
    }
  }
  std::vector<bool> turn(side.size());
  std::transform(side.begin(), side.end(), turn.begin(), [](int s) { return s < 0; });
  return turn;
}

void turn(RawSurface& surface, const std::vector<bool>& which) {
  for (std::size_t t = 0; t < which.size(); ++t)
    if (which[t]) std::swap(surface.triangles[t][1], surface.triangles[t][2]);
}

}  // namespace

void merge_points(Repaired& state, double tolerance) {
  RawSurface& surface = state.surface;
  const std::vector<int> first = first_at_place(surface.points, tolerance);
  RepairNote merged{RepairKind::points_merged};
  for (std::size_t i = 0; i < first.size(); ++i)
    if (first[i] != static_cast<int>(i)) ++merged.count, merged.place = surface.points.col(static_cast<int>(i));
  if (merged.count > 0) state.notes.push_back(merged);
  std::set<Triangle> seen;
  std::vector<bool> keep;
  for (Triangle& triangle : surface.triangles) {
    for (int& n : triangle) n = first[n];
    Triangle sorted = triangle;
    std::sort(sorted.begin(), sorted.end());
    keep.push_back(sorted[0] != sorted[1] && sorted[1] != sorted[2] && seen.insert(sorted).second);
  }
  const auto dropped = static_cast<int>(std::count(keep.begin(), keep.end(), false));
  if (dropped > 0)
    drop(state, keep, RepairKind::triangles_dropped, dropped);
  else
    surface = kept(surface, keep);
}

void drop_fins(Repaired& state) {
  while (true) {
    const EdgeUses edges = edges_of(state.surface.triangles);
    const std::vector<int> patch = patches_of(state.surface.triangles.size(), edges);
    const std::vector<double> areas = areas_by(state.surface, patch);
    int fin = -1;
    std::vector<Vec3> places;
    for (const auto& [edge, uses] : edges) {
      if (uses.size() < 3) continue;
      places.emplace_back((state.surface.points.col(edge.first) + state.surface.points.col(edge.second)) / 2);
      for (const EdgeUse& use : uses)
        if (fin < 0 || areas[patch[use.triangle]] < areas[fin]) fin = patch[use.triangle];
    }
    if (fin < 0) return;
    if (areas[fin] > largest_fin * total_area(state.surface.points, state.surface.triangles))
      throw PlacedError(fmt::format("more than two triangles meet at {} edges, the first at {}: parts of the surface "
                                    "touch; separate them where they do",
                                    places.size(), text_of_place(places.front())),
                        places);
    std::vector<bool> keep(patch.size());
    for (std::size_t t = 0; t < patch.size(); ++t) keep[t] = patch[t] != fin;
    drop(state, keep, RepairKind::fins_dropped, 1);
  }
}

void keep_largest_piece(Repaired& state) {
  const std::vector<int> patch = patches_of(state.surface.triangles.size(), edges_of(state.surface.triangles));
  const std::vector<double> areas = areas_by(state.surface, patch);
  if (areas.size() < 2) return;
  const auto largest = std::max_element(areas.begin(), areas.end()) - areas.begin();
  std::vector<bool> keep(patch.size());
  for (std::size_t t = 0; t < patch.size(); ++t) keep[t] = patch[t] == largest;
  drop(state, keep, RepairKind::pieces_dropped, static_cast<int>(areas.size()) - 1);
}

void split_points(Repaired& state) {
  RawSurface& surface = state.surface;
  RepairNote note{RepairKind::points_split};
  std::vector<Vec3> added;
  const auto fans = fans_of(surface);
  for (std::size_t n = 0; n < fans.size(); ++n)
    for (std::vector<int> around = fans[n]; !around.empty();) {
      const std::vector<int> fan = first_fan(surface, around);
      std::erase_if(around, [&](int t) { return std::find(fan.begin(), fan.end(), t) != fan.end(); });
      if (around.empty()) break;
      Vec3 toward = Vec3::Zero();
      const auto fresh = static_cast<int>(surface.points.cols() + static_cast<Eigen::Index>(added.size()));
      for (const int t : fan) toward += middle(surface, static_cast<std::size_t>(t)) / static_cast<double>(fan.size());
      note.place = surface.points.col(static_cast<int>(n));
      added.emplace_back(note.place + 0.05 * (toward - note.place));
      for (const int t : fan)
        std::replace(surface.triangles[t].begin(), surface.triangles[t].end(), static_cast<int>(n), fresh);
      ++note.count;
    }
  if (added.empty()) return;
  const Eigen::Index before = surface.points.cols();
  surface.points.conservativeResize(3, before + static_cast<Eigen::Index>(added.size()));
  for (std::size_t i = 0; i < added.size(); ++i) surface.points.col(before + static_cast<Eigen::Index>(i)) = added[i];
  state.notes.push_back(note);
}

void orient(Repaired& state) {
  RawSurface& surface = state.surface;
  std::vector<bool> which = turned_alike(surface);
  turn(surface, which);
  if (enclosed_volume(surface) < 0) {
    turn(surface, std::vector<bool>(which.size(), true));
    which.flip();
  }
  RepairNote note{RepairKind::triangles_turned, static_cast<int>(std::count(which.begin(), which.end(), true))};
  for (std::size_t t = 0; t < which.size(); ++t)
    if (which[t]) note.place = middle(surface, t);
  if (note.count > 0) state.notes.push_back(note);
}

double enclosed_volume(const RawSurface& surface) {
  double volume = 0;
  const Vec3 origin = surface.points.rowwise().mean();
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    volume += (a - origin).dot((b - origin).cross(c - origin)) / 6;
  };
  for (const Triangle& t : surface.triangles)
    add(surface.points.col(t[0]), surface.points.col(t[1]), surface.points.col(t[2]));
  for (const auto& loop : loops_of(surface.triangles)) {
    const Points rim = points_at(surface.points, loop);
    const Vec3 centre = rim.rowwise().mean();
    for (Eigen::Index i = 0; i < rim.cols(); ++i) add(centre, rim.col((i + 1) % rim.cols()), rim.col(i));
  }
  return volume;
}

}  // namespace tether
