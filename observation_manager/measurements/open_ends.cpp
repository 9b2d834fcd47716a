#include "observation_manager/measurements/open_ends.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/mesh/surface.hpp"
#include "common/mesh/topology.hpp"

namespace tether {
namespace {

/// Whether a triangle can belong to the flat end of an opening.
bool may_close(const Opening& opening, const Points& points, const Triangle& t) {
  constexpr double least_cosine = 0.7, widest = 1.5;  // 45 degrees; radii
  if (area_vector(points, t).normalized().dot(opening.axis) < least_cosine) return false;
  const Vec3 arm = points(Eigen::all, t).rowwise().mean() - opening.centre;
  const double along = arm.dot(opening.axis);
  return std::abs(along) <= opening.radius && (arm - along * opening.axis).norm() <= widest * opening.radius;
}

/// Whether the axis passes through a triangle: seen along it, the centre lies in the triangle.
bool is_met(const Opening& opening, const Points& points, const Triangle& t) {
  const auto corner = [&](std::size_t i) { return Vec3(points.col(t[i]) - opening.centre); };
  for (std::size_t i = 0; i < 3; ++i)
    if (corner(i).cross(corner((i + 1) % 3)).dot(opening.axis) < 0) return false;
  return true;
}

/// Marks the triangles that close an opening; their number.
int mark_end(const Opening& opening, const TriangleSurface& surface, std::vector<bool>& keep) {
  std::vector<std::size_t> number;
  std::vector<Triangle> candidates;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (may_close(opening, surface.points, surface.triangles[t])) {
      number.push_back(t);
      candidates.push_back(surface.triangles[t]);
    }
  const Parts parts = connected_parts(static_cast<int>(surface.points.cols()), candidates);
  std::vector<bool> closes(static_cast<std::size_t>(parts.count), false);
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (is_met(opening, surface.points, candidates[i])) closes[static_cast<std::size_t>(parts.part[i])] = true;
  int count = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (closes[static_cast<std::size_t>(parts.part[i])] && keep[number[i]]) keep[number[i]] = false, ++count;
  return count;
}

}  // namespace

std::vector<Opening> openings_of(const LumenSurface& lumen) {
  std::vector<Opening> openings;
  for (const std::vector<int>& rim : rims(lumen.triangles)) {
    const Points loop = lumen.points(Eigen::all, rim);
    const Plane plane = plane_of_loop(loop);
    double length = 0;
    for (Eigen::Index i = 0; i < loop.cols(); ++i) length += (loop.col(i) - loop.col((i + 1) % loop.cols())).norm();
    openings.push_back({plane.origin, -plane.normal, length / (2 * std::numbers::pi)});
  }
  return openings;
}

void open_ends(CheckedSurface& checked, const std::vector<Opening>& openings) {
  const bool was_closed = open_edges(checked.surface.triangles).empty();
  std::vector<bool> keep(checked.surface.triangles.size(), true);
  int ends = 0, gone = 0;
  for (const Opening& opening : openings)
    if (const int count = mark_end(opening, checked.surface, keep); count > 0) ++ends, gone += count;
  if (was_closed && ends < static_cast<int>(openings.size()))
    checked.notes.push_back(fmt::format(
        "is closed, but shows a flat end at {} of the model's {} open ends only: what else closes it counts as wall",
        ends, openings.size()));
  if (gone == 0 || gone == static_cast<int>(keep.size())) return;
  checked.notes.push_back(fmt::format(
      "{} flat ends with {} triangles at the model's open ends are no wall, and left out; beside them nothing "
      "is observed",
      ends, gone));
  if (!checked.flawed.empty()) {
    std::vector<bool> flawed;
    for (std::size_t t = 0; t < keep.size(); ++t)
      if (keep[t]) flawed.push_back(checked.flawed[t]);
    checked.flawed = std::move(flawed);
  }
  checked.surface = part_of(checked.surface, keep);
}

TriangleSurface closed_by_fans(const LumenSurface& lumen) {
  TriangleSurface surface{lumen.points, lumen.triangles};
  for (const std::vector<int>& rim : rims(lumen.triangles)) {
    const auto middle = static_cast<int>(surface.points.cols());
    surface.points.conservativeResize(3, middle + 1);
    surface.points.col(middle) = lumen.points(Eigen::all, rim).rowwise().mean();
    for (std::size_t i = 0; i < rim.size(); ++i)
      surface.triangles.push_back({rim[(i + 1) % rim.size()], rim[i], middle});
  }
  return surface;
}

double mean_radius(const TriangleSurface& surface) {
  return 2 * std::abs(enclosed_volume(surface, rims(surface.triangles))) /
         total_area(surface.points, surface.triangles);
}

}  // namespace tether
