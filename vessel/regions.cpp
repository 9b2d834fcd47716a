#include "vessel/regions.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "common/base/error.hpp"
#include "common/mesh/topology.hpp"
#include "common/mesh/triangle_locator.hpp"
#include "vessel/anatomy/cut.hpp"

namespace tether {
namespace {

constexpr double rounding = 1e-9;  ///< of a turn, of the length

/// Angle and position at the corners of a triangle, the angle without a jump.
struct Places {
  Vec3 angle, position;
};

/// Borders of the rectangle in which a region lies, turned by so many whole turns.
std::vector<Side> sides_of(const WallRegion& region, const Places& at, int turns) {
  std::vector<Side> sides{{{at.position, region.position_from, rounding}, false},
                          {{at.position, region.position_to, rounding}, true}};
  const double to = region.angle_to + (region.angle_to < region.angle_from ? 360 : 0);
  if (to - region.angle_from >= 360) return sides;
  sides.push_back({{at.angle, region.angle_from + 360 * turns, 360 * rounding}, false});
  sides.push_back({{at.angle, to + 360 * turns, 360 * rounding}, true});
  return sides;
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

/// What each region has of a triangle.
std::vector<std::vector<TrianglePart>> divided(const Triangle& triangle, const std::vector<WallRegion>& regions,
                                               const std::string& field, const Places& at) {
  Polygons left{whole_triangle()};
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
          "{}: no region holds the outer wall at angle {:.1f} degrees, position {:.2f}: "
          "end the list with a region without limits",
          field, at.angle.dot(middle), at.position.dot(middle));
    }
  return result;
}

const Patch& region_named(const std::string& name, const std::vector<Patch>& regions) {
  const auto found =
      std::find_if(regions.begin(), regions.end(), [&](const Patch& patch) { return patch.name == name; });
  TETHER_ASSERT(found != regions.end(), "no region {}", name);
  return *found;
}

/// Of which a patch has a part.
std::set<Triangle> triangles_of(const Patch& patch) {
  std::set<Triangle> triangles;
  for (const TrianglePart& part : parts_of(patch)) triangles.insert(part.of);
  return triangles;
}

/// Of all that the patches have, exactly.
TriangleLocator locator_of(const std::vector<const Patch*>& patches, const Points& points) {
  std::vector<TrianglePart> parts;
  for (const Patch* patch : patches)
    for (const TrianglePart& part : parts_of(*patch)) parts.push_back(part);
  Points corners(3, 3 * static_cast<Eigen::Index>(parts.size()));
  std::vector<Triangle> triangles;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto first = 3 * static_cast<int>(k);
    corners.middleCols<3>(first) = points(Eigen::all, parts[k].of) * parts[k].corners;
    triangles.push_back({first, first + 1, first + 2});
  }
  return {std::move(corners), std::move(triangles)};
}

/// What is taken of a patch, piece by piece.
class PartOfPatch {
 public:
  explicit PartOfPatch(const Patch& whole) : whole_(whole), part_{whole.name, {}} {}
  void add(const TrianglePart& piece) {
    part_.parts.push_back(piece);
    shares_[piece.of] += piece.share();
  }
  Patch finished() {
    for (const Triangle& triangle : whole_.triangles)
      if (const auto own = shares_.find(triangle); own != shares_.end() && own->second >= 0.5)
        part_.triangles.push_back(triangle);
    return std::move(part_);
  }

 private:
  const Patch& whole_;
  Patch part_;
  std::map<Triangle, double> shares_;
};

/// By the midpoints of its edges.
std::array<TrianglePart, 4> quarters(const TrianglePart& part) {
  Mat3 middles;
  for (int i = 0; i < 3; ++i) middles.col(i) = (part.corners.col(i) + part.corners.col((i + 1) % 3)) / 2;
  std::array<TrianglePart, 4> result{TrianglePart{part.of, middles}};
  for (int i = 0; i < 3; ++i) {
    TrianglePart& at_corner = result[static_cast<std::size_t>(i) + 1];
    at_corner.of = part.of;
    at_corner.corners << part.corners.col(i), middles.col(i), middles.col((i + 2) % 3);
  }
  return result;
}

struct PiecesByDistance {
  std::vector<TrianglePart> near, far;
};

/// A part of a triangle, cut where it leaves the ball. corners: of the triangle, from the ball's centre.
PiecesByDistance by_distance(const TrianglePart& part, const Mat3& corners, double distance) {
  constexpr double fine = 0.125;  // of the distance: a chord's area is then right to a fifth of a per cent
  const Mat3 x = corners * part.corners;
  const Vec3 away = x.colwise().norm();
  double longest = 0;
  for (int i = 0; i < 3; ++i) longest = std::max(longest, (x.col(i) - x.col((i + 1) % 3)).norm());
  if (away.maxCoeff() <= distance) return {{part}, {}};
  if (away.minCoeff() - longest >= distance) return {{}, {part}};
  if (longest <= fine * distance) {
    const Vec3 on_triangle = part.corners.transpose().inverse() * away;
    const Halves halves =
        split({part.corners.col(0), part.corners.col(1), part.corners.col(2)}, {on_triangle, distance, rounding});
    return {triangulated(halves.less, part.of), triangulated(halves.more, part.of)};
  }
  PiecesByDistance pieces;
  for (const TrianglePart& quarter : quarters(part)) {
    const PiecesByDistance of = by_distance(quarter, corners, distance);
    pieces.near.insert(pieces.near.end(), of.near.begin(), of.near.end());
    pieces.far.insert(pieces.far.end(), of.far.begin(), of.far.end());
  }
  if (pieces.near.empty()) return {{}, {part}};
  return pieces;
}

}  // namespace

std::vector<Patch> divide_by_regions(const std::vector<Triangle>& triangles, const std::vector<WallRegion>& regions,
                                     const std::string& field, const std::function<WallPlace(int node)>& place) {
  std::vector<std::string> names;
  for (const WallRegion& region : regions) names.push_back(region.name);
  SharedPatches shared(names);
  for (const Triangle& triangle : triangles)
    shared.add(triangle, divided(triangle, regions, field, places_of(triangle, place)));
  std::vector<Patch> patches = shared.finished();
  for (const Patch& patch : patches)
    if (patch.triangles.empty())
      throw input_error(
          "{}: {} holds no triangle of the outer wall: its limits are too narrow for this mesh, or an earlier region "
          "takes all of it",
          field, patch.name);
  return patches;
}

Patch part_between(const Patch& patch, const VectorXd& function, double from, double to) {
  PartOfPatch part(patch);
  for (const TrianglePart& whole : parts_of(patch)) {
    const Vec3 values(function[whole.of[0]], function[whole.of[1]], function[whole.of[2]]);
    const Polygon corners{whole.corners.col(0), whole.corners.col(1), whole.corners.col(2)};
    const Polygon beyond = split(corners, {values, from, rounding}).more;
    if (beyond.empty()) continue;
    for (const TrianglePart& piece : triangulated(split(beyond, {values, to, rounding}).less, whole.of))
      part.add(piece);
  }
  return part.finished();
}

NearAndFar divided_by_distance(const Patch& patch, const Points& points, const Vec3& centre, double distance) {
  PartOfPatch near(patch), far(patch);
  for (const TrianglePart& whole : parts_of(patch)) {
    const Mat3 corners = points(Eigen::all, whole.of);
    const PiecesByDistance pieces = by_distance(whole, corners.colwise() - centre, distance);
    for (const TrianglePart& piece : pieces.near) near.add(piece);
    for (const TrianglePart& piece : pieces.far) far.add(piece);
  }
  return {near.finished(), far.finished()};
}

Neighbours neighbours_of(const std::vector<Patch>& regions) {
  std::map<Edge, std::set<std::size_t>> at;  // which regions have a part of a triangle at this edge
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (const Triangle& t : triangles_of(regions[r]))
      for (std::size_t i = 0; i < 3; ++i)
        at[{std::min(t[i], t[(i + 1) % 3]), std::max(t[i], t[(i + 1) % 3])}].insert(r);
  std::vector<std::set<std::size_t>> beside(regions.size());
  for (const auto& [edge, some] : at)
    for (const std::size_t r : some) beside[r].insert(some.begin(), some.end());
  Neighbours result;
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (const std::size_t other : beside[r])
      if (other != r) result[regions[r].name].push_back(regions[other].name);
  return result;
}

VectorXd nearness(const std::string& neighbour, const std::string& region, const std::vector<Patch>& regions,
                  const Points& points) {
  std::vector<const Patch*> others;
  const std::vector<std::string> beside = neighbours_of(regions)[region];
  for (const std::string& name : beside)
    if (name != neighbour) others.push_back(&region_named(name, regions));
  const TriangleLocator there = locator_of({&region_named(neighbour, regions)}, points),
                        elsewhere = locator_of(others, points);
  VectorXd result = VectorXd::Zero(points.cols());
  for (const Triangle& triangle : triangles_of(region_named(region, regions)))
    for (const int node : triangle) {
      const double near = there.nearest(points.col(node)).distance, far = elsewhere.nearest(points.col(node)).distance;
      result[node] = far + near > 0 ? (far - near) / (far + near) : 0;
    }
  return result;
}

}  // namespace tether
