#include "observation_manager/measurements/surface_check.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "common/base/error.hpp"
#include "common/mesh/surface.hpp"
#include "common/mesh/topology.hpp"
#include "observation_manager/measurements/self_intersection.hpp"
#include "vessel/coordinates.hpp"

namespace tether {
namespace {

/// Only the points that triangles use, equal ones as one, in the order of their use.
TriangleSurface welded(const TriangleSurface& given) {
  const auto at = [&](int node) { return given.points.data() + 3 * static_cast<std::ptrdiff_t>(node); };
  std::vector<int> order(static_cast<std::size_t>(given.points.cols()));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return std::lexicographical_compare(at(a), at(a) + 3, at(b), at(b) + 3); });
  std::vector<int> same(order.size());  // one of the equal points
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool like_last = i > 0 && std::equal(at(order[i]), at(order[i]) + 3, at(order[i - 1]));
    same[static_cast<std::size_t>(order[i])] = like_last ? same[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  std::vector<int> number(order.size(), -1), used;
  TriangleSurface surface{Points(3, 0), given.triangles};
  for (Triangle& t : surface.triangles)
    for (int& node : t) {
      const int point = same[static_cast<std::size_t>(node)];
      int& its = number[static_cast<std::size_t>(point)];
      if (its < 0) its = static_cast<int>(used.size()), used.push_back(point);
      node = its;
    }
  surface.points = given.points(Eigen::all, used);
  return surface;
}

/// Narrower than 1e-10 of its longest side.
bool without_area(const Points& points, const Triangle& t) {
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    longest = std::max(longest, (points.col(t[i]) - points.col(t[(i + 1) % 3])).norm());
  return !(area_vector(points, t).norm() > 1e-10 * longest * longest);
}

void check_edges(const std::string& name, const TriangleSurface& surface) {
  int crowded = 0, disagreeing = 0;
  std::string first_crowded, first_disagreeing;
  for (const auto& [edge, up, down] : edge_uses(surface.triangles)) {
    const auto place = [&, nodes = edge] {
      return coordinates(0.5 * (surface.points.col(nodes[0]) + surface.points.col(nodes[1])));
    };
    if (up + down > 2 && crowded++ == 0) first_crowded = place();
    if (up + down == 2 && up != 1 && disagreeing++ == 0) first_disagreeing = place();
  }
  if (crowded > 0)
    throw input_error("{}: {} edges have more than two triangles, the first near {}: not the surface of a lumen", name,
                      crowded, first_crowded);
  if (disagreeing > 0)
    throw input_error(
        "{}: the normals of neighbouring triangles disagree at {} edges, the first near {}: inside and outside cannot "
        "be told",
        name, disagreeing, first_disagreeing);
}

/// Leaves out points that lie ten times as far from the middle of all as 99 of 100 do, with their triangles: an
/// overflow, a slip of the pen. No vessel is so uneven.
void leave_out_far_points(const std::string& name, TriangleSurface& surface, std::vector<std::string>& notes) {
  const auto quantile = [](std::vector<double> values, double share) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
  };
  Vec3 middle;
  for (int axis = 0; axis < 3; ++axis)
    middle[axis] = quantile({surface.points.row(axis).begin(), surface.points.row(axis).end()}, 0.5);
  std::vector<double> away;
  for (const auto& x : surface.points.colwise()) away.push_back((x - middle).stableNorm());
  const double limit = 10 * quantile(away, 0.99);
  const auto is_far = [&](int node) { return away[static_cast<std::size_t>(node)] > limit; };
  const auto far = std::count_if(away.begin(), away.end(), [&](double d) { return d > limit; });
  if (far == 0) return;
  const auto first = std::find_if(away.begin(), away.end(), [&](double d) { return d > limit; }) - away.begin();
  const std::string place = coordinates(surface.points.col(first));
  const auto gone =
      std::erase_if(surface.triangles, [&](const Triangle& t) { return std::any_of(t.begin(), t.end(), is_far); });
  notes.push_back(
      fmt::format("{} points far from all others, the first at {}, are left out with {} triangles", far, place, gone));
  if (surface.triangles.empty()) throw input_error("{}: {}: none are left", name, notes.back());
  surface = welded(surface);
}

/// Leaves out loose pieces that are small, never the largest.
void keep_large_parts(const std::string& name, TriangleSurface& surface, std::vector<std::string>& notes) {
  const Parts parts = connected_parts(static_cast<int>(surface.points.cols()), surface.triangles);
  std::vector<double> area(static_cast<std::size_t>(parts.count), 0.0);
  const auto part = [&](std::size_t t) { return static_cast<std::size_t>(parts.part[t]); };
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    area[part(t)] += area_vector(surface.points, surface.triangles[t]).norm();
  const double whole = std::accumulate(area.begin(), area.end(), 0.0),
               largest = *std::max_element(area.begin(), area.end());
  const double smallest = std::min(0.05 * whole, largest);
  double of_small = 0;
  for (const double a : area) of_small += a < smallest ? a : 0;
  if (of_small > 0.5 * whole)
    throw input_error(
        "{}: falls into {} separate pieces, the largest with {:.0f} % of the area: must be one surface. Are the "
        "corners of "
        "neighbouring triangles at slightly different points? Then merge them",
        name, parts.count, 100 * largest / whole);
  const auto small = std::count_if(area.begin(), area.end(), [&](double a) { return a < smallest; });
  if (parts.count - small > 1) notes.push_back(fmt::format("consists of {} separate pieces", parts.count - small));
  if (small == 0) return;
  std::vector<Triangle> kept;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (area[part(t)] >= smallest) kept.push_back(surface.triangles[t]);
  notes.push_back(
      fmt::format("{} loose pieces with {} triangles are left out", small, surface.triangles.size() - kept.size()));
  surface.triangles = std::move(kept);
  surface = welded(surface);
}

/// The open rims, which must not touch each other.
std::vector<std::vector<int>> holes_of(const std::string& name, const TriangleSurface& surface) {
  std::map<int, int> leaving;
  for (const Edge& edge : open_edges(surface.triangles)) ++leaving[edge[0]];
  const auto forks = std::count_if(leaving.begin(), leaving.end(), [](const auto& node) { return node.second > 1; });
  if (forks == 0) return rims(surface.triangles);
  const auto first = std::find_if(leaving.begin(), leaving.end(), [](const auto& node) { return node.second > 1; });
  throw input_error("{}: its open edges fork at {} points, the first at {}: holes must not touch each other", name,
                    forks, coordinates(surface.points.col(first->first)));
}

/// Piece by piece: they may come from different hands.
void turn_outward(TriangleSurface& surface, std::vector<std::string>& notes) {
  const Parts parts = connected_parts(static_cast<int>(surface.points.cols()), surface.triangles);
  int turned = 0;
  for (int part = 0; part < parts.count; ++part) {
    std::vector<std::size_t> own;
    TriangleSurface piece{surface.points, {}};
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
      if (parts.part[t] == part) own.push_back(t), piece.triangles.push_back(surface.triangles[t]);
    if (enclosed_volume(piece, rims(piece.triangles)) >= 0) continue;
    for (const std::size_t t : own) std::swap(surface.triangles[t][1], surface.triangles[t][2]);
    ++turned;
  }
  if (turned > 0 && turned == parts.count) notes.emplace_back("its normals looked inward; turned");
  if (turned > 0 && turned < parts.count)
    notes.push_back(fmt::format("the normals of {} of its {} pieces looked inward; turned", turned, parts.count));
}

void note_holes(const TriangleSurface& surface, const std::vector<std::vector<int>>& holes,
                std::vector<std::string>& notes) {
  if (holes.empty()) return;
  std::string lengths;
  for (const std::vector<int>& hole : holes) {
    double length = 0;
    for (std::size_t i = 0; i < hole.size(); ++i)
      length += (surface.points.col(hole[i]) - surface.points.col(hole[(i + 1) % hole.size()])).norm();
    lengths += fmt::format("{}{:.3g}", lengths.empty() ? "" : ", ", length);
  }
  notes.push_back(
      fmt::format("{} open rims, around them {} (in the case's unit of length); beside them nothing is observed",
                  holes.size(), lengths));
}

std::vector<bool> crossing_triangles(const std::string& name, const TriangleSurface& surface,
                                     std::vector<std::string>& notes) {
  std::vector<bool> hit = self_intersections(surface);
  const auto count = static_cast<std::size_t>(std::count(hit.begin(), hit.end(), true));
  if (count == 0) return {};
  const auto first = static_cast<std::size_t>(std::find(hit.begin(), hit.end(), true) - hit.begin());
  const std::string said = fmt::format("{} of {} triangles pass through each other, the first near {}", count,
                                       hit.size(), coordinates(surface.points.col(surface.triangles[first][0])));
  if (count * 100 > hit.size()) throw input_error("{}: {}: more than a hundredth", name, said);
  notes.push_back(said + "; nothing is observed there");
  return hit;
}

}  // namespace

double enclosed_volume(const TriangleSurface& surface, const std::vector<std::vector<int>>& holes) {
  const auto cone = [](const Vec3& a, const Vec3& b, const Vec3& c) { return a.cross(b).dot(c) / 6; };
  const Vec3 origin = surface.points.rowwise().mean();
  const auto x = [&](int node) { return Vec3(surface.points.col(node) - origin); };
  double volume = 0;
  for (const Triangle& t : surface.triangles) volume += cone(x(t[0]), x(t[1]), x(t[2]));
  for (const std::vector<int>& hole : holes) {
    const Vec3 middle = surface.points(Eigen::all, hole).rowwise().mean() - origin;
    for (std::size_t i = 0; i < hole.size(); ++i) volume += cone(x(hole[(i + 1) % hole.size()]), x(hole[i]), middle);
  }
  return volume;
}

CheckedSurface checked_surface(const std::string& name, TriangleSurface given) {
  if (given.triangles.empty()) throw input_error("{}: holds no triangles: must be the surface of the lumen", name);
  CheckedSurface result{welded(given), {}, {}};
  TriangleSurface& surface = result.surface;
  leave_out_far_points(name, surface, result.notes);
  const auto dropped =
      std::erase_if(surface.triangles, [&](const Triangle& t) { return without_area(surface.points, t); });
  if (surface.triangles.empty()) throw input_error("{}: none of its triangles has an area", name);
  if (dropped > 0) {
    result.notes.push_back(fmt::format("{} triangles without area are left out", dropped));
    surface = welded(surface);
  }
  check_edges(name, surface);
  keep_large_parts(name, surface, result.notes);
  const std::vector<std::vector<int>> holes = holes_of(name, surface);
  turn_outward(surface, result.notes);
  note_holes(surface, holes, result.notes);
  result.flawed = crossing_triangles(name, surface, result.notes);
  return result;
}

double box_size(const Points& x) {
  return (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
}

std::string placement(const Points& data, const Points& model) {
  const auto box = [](const Points& x) {
    return coordinates(x.rowwise().minCoeff()) + " to " + coordinates(x.rowwise().maxCoeff());
  };
  std::string said = fmt::format("the data reach from {}, the model from {}", box(data), box(model));
  if (const int power = power_of_ten(box_size(data) / box_size(model)); power != 0)
    said += fmt::format(". In another unit? Multiplied by {:g} they would be about as large", std::pow(10.0, -power));
  return said;
}

int power_of_ten(double ratio) {
  const double power = std::log10(ratio), whole = std::round(power);
  return std::isfinite(power) && std::abs(power - whole) < 0.35 ? static_cast<int>(whole) : 0;
}

std::string guessed_unit(int power, const std::string& stated) {
  const std::string larger = fmt::format("about {:g} times {} than the model", std::pow(10.0, std::abs(power)),
                                         power > 0 ? "larger" : "smaller");
  constexpr std::array units{std::pair{"mm", -3}, std::pair{"cm", -2}, std::pair{"m", 0}};
  for (const auto& [word, exponent] : units)
    if (stated == word)
      for (const auto& [other, its] : units)
        if (its == exponent - power) return fmt::format("{}: is its unit {}, not {}?", larger, other, stated);
  return larger + ": in another unit?";
}

Placing placing_of(const TriangleSurface& surface, const LumenSurface& lumen, double reach) {
  constexpr double alike = 0.5;  // cosine: 60 degrees
  const Points normals = nodal_normals(lumen.points, lumen.triangles);
  const std::vector<Closest> found = SignedSurface(surface).closest(lumen.points);
  double faced = 0, opposed = 0, near = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].on_rim) continue;
    ++faced;
    if (std::abs(found[i].distance) > reach) continue;
    const Triangle& facet = surface.triangles[static_cast<std::size_t>(found[i].triangle)];
    const double cosine =
        area_vector(surface.points, facet).normalized().dot(normals.col(static_cast<Eigen::Index>(i)));
    opposed += cosine < 0 ? 1 : 0;
    near += cosine >= alike ? 1 : 0;
  }
  const double all = static_cast<double>(found.size()), some = std::max(1.0, faced);
  return {faced / all, near / some, opposed / some};
}

}  // namespace tether
