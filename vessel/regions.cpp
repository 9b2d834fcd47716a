#include "vessel/regions.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/error.hpp"

namespace tether {
namespace {

/// A convex piece of a triangle: its corners in the triangle's barycentric coordinates.
using Polygon = std::vector<Vec3>;
using Polygons = std::vector<Polygon>;

/// A border: where a function, linear on the triangle and given at its corners, has a value.
struct Border {
  Vec3 function;
  double value, tolerance;
  double beyond(const Vec3& x) const { return function.dot(x) - value; }
};

constexpr double rounding = 1e-9;  ///< of a turn, of the length, of a triangle's area

/// What of the polygon is on the side where the function is less, and what on the other; none if it only touches.
struct Halves {
  Polygon less, more;
};
Halves split(const Polygon& polygon, const Border& border) {
  const auto any = [&](double sign) {
    return std::any_of(polygon.begin(), polygon.end(),
                       [&](const Vec3& x) { return sign * border.beyond(x) > border.tolerance; });
  };
  if (!any(1)) return {polygon, {}};
  if (!any(-1)) return {{}, polygon};
  Halves halves;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = border.beyond(a), at_b = border.beyond(b);
    if (at_a <= 0) halves.less.push_back(a);
    if (at_a >= 0) halves.more.push_back(a);
    if (at_a * at_b >= 0) continue;
    const Vec3 between = (at_b * a - at_a * b) / (at_b - at_a);
    halves.less.push_back(between), halves.more.push_back(between);
  }
  return halves;
}

std::vector<TrianglePart> triangulated(const Polygon& polygon, const Triangle& of) {
  std::vector<TrianglePart> parts;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    TrianglePart part{of};
    part.corners << polygon[0], polygon[i], polygon[i + 1];
    if (part.share() > rounding) parts.push_back(part);
  }
  return parts;
}

/// Angle and position at the corners of a triangle, the angle without a jump.
struct Places {
  Vec3 angle, position;
};

/// Borders of the rectangle in which a region lies, turned by so many whole turns; what is beyond one is outside.
struct Side {
  Border border;
  bool inside_is_less;
};
std::vector<Side> sides_of(const WallRegion& region, const Places& at, int turns) {
  std::vector<Side> sides{{{at.position, region.position_from, rounding}, false},
                          {{at.position, region.position_to, rounding}, true}};
  const double to = region.angle_to + (region.angle_to < region.angle_from ? 360 : 0);
  if (to - region.angle_from >= 360) return sides;
  sides.push_back({{at.angle, region.angle_from + 360 * turns, 360 * rounding}, false});
  sides.push_back({{at.angle, to + 360 * turns, 360 * rounding}, true});
  return sides;
}

/// Takes what lies within the sides out of `left`.
Polygons taken(Polygons& left, const std::vector<Side>& sides) {
  Polygons inside, outside;
  for (Polygon polygon : left) {
    for (const Side& side : sides) {
      if (polygon.empty()) break;
      Halves halves = split(polygon, side.border);
      polygon = side.inside_is_less ? halves.less : halves.more;
      Polygon& other = side.inside_is_less ? halves.more : halves.less;
      if (!other.empty()) outside.push_back(std::move(other));
    }
    if (!polygon.empty()) inside.push_back(std::move(polygon));
  }
  left = std::move(outside);
  return inside;
}

Places places_of(const Triangle& triangle, const std::function<WallPlace(int node)>& place) {
  Places at;
  for (std::size_t i = 0; i < 3; ++i) {
    const WallPlace here = place(triangle[i]);
    const auto corner = static_cast<Eigen::Index>(i);
    at.angle[corner] = i == 0 ? here.angle : at.angle[0] + std::remainder(here.angle - at.angle[0], 360);
    at.position[corner] = here.position;
  }
  return at;
}

double share_of(const std::vector<TrianglePart>& parts) {
  double sum = 0;
  for (const TrianglePart& part : parts) sum += part.share();
  return sum;
}

/// What each region has of a triangle.
std::vector<std::vector<TrianglePart>> divided(const Triangle& triangle, const std::vector<WallRegion>& regions,
                                               const Places& at) {
  Polygons left{{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()}};
  std::vector<std::vector<TrianglePart>> result;
  for (const WallRegion& region : regions) {
    result.emplace_back();
    for (int turns = -2; turns <= 2; ++turns)
      for (const Polygon& polygon : taken(left, sides_of(region, at, turns)))
        for (const TrianglePart& part : triangulated(polygon, triangle)) result.back().push_back(part);
  }
  for (const Polygon& polygon : left)
    if (const auto hole = triangulated(polygon, triangle); !hole.empty()) {
      const Vec3 middle = hole.front().corners.rowwise().mean();
      throw input_error(
          "mesh.regions: no region holds the outer wall at angle {:.1f} degrees, position {:.2f}: "
          "end the list with a region without limits",
          at.angle.dot(middle), at.position.dot(middle));
    }
  return result;
}

}  // namespace

std::vector<Patch> divide_by_regions(const std::vector<Triangle>& triangles, const std::vector<WallRegion>& regions,
                                     const std::function<WallPlace(int node)>& place) {
  std::vector<Patch> patches;
  for (const WallRegion& region : regions) patches.push_back({region.name, {}});
  bool any_cut = false;
  for (const Triangle& triangle : triangles) {
    const auto shares = divided(triangle, regions, places_of(triangle, place));
    const auto most = std::max_element(shares.begin(), shares.end(),
                                       [](const auto& a, const auto& b) { return share_of(a) < share_of(b); });
    any_cut |= share_of(*most) < 1;
    patches[static_cast<std::size_t>(most - shares.begin())].triangles.push_back(triangle);
    for (std::size_t i = 0; i < patches.size(); ++i)
      patches[i].parts.insert(patches[i].parts.end(), shares[i].begin(), shares[i].end());
  }
  for (Patch& patch : patches) {
    if (patch.triangles.empty())
      throw input_error(
          "mesh.regions.{}: holds no triangle of the outer wall: its limits are too narrow for this mesh, or an "
          "earlier region takes all of it",
          patch.name);
    if (!any_cut) patch.parts.clear();
  }
  return patches;
}

Patch part_between(const Patch& patch, const VectorXd& function, double from, double to) {
  Patch part{patch.name, {}};
  std::map<Triangle, double> shares;
  for (const TrianglePart& whole : parts_of(patch)) {
    const Vec3 values(function[whole.of[0]], function[whole.of[1]], function[whole.of[2]]);
    const Polygon corners{whole.corners.col(0), whole.corners.col(1), whole.corners.col(2)};
    const Polygon beyond = split(corners, {values, from, rounding}).more;
    if (beyond.empty()) continue;
    for (const TrianglePart& piece : triangulated(split(beyond, {values, to, rounding}).less, whole.of)) {
      part.parts.push_back(piece);
      shares[whole.of] += piece.share();
    }
  }
  for (const Triangle& triangle : patch.triangles)
    if (const auto own = shares.find(triangle); own != shares.end() && own->second >= 0.5)
      part.triangles.push_back(triangle);
  return part;
}

}  // namespace tether
