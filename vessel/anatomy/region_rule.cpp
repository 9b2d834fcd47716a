#include "vessel/anatomy/region_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/error.hpp"
#include "common/mesh/mesh.hpp"
#include "common/mesh/surface.hpp"
#include "vessel/anatomy/conditions.hpp"
#include "vessel/anatomy/cut.hpp"

namespace tether {

namespace {

constexpr int pieces = 3;  ///< of a side of a triangle that a border cuts: borders bend

std::vector<Side> sides_on(const Triangle& t, const AllOf& functions, double tolerance) {
  std::vector<Side> sides;
  for (const VectorXd& function : functions)
    sides.push_back({{Vec3(function[t[0]], function[t[1]], function[t[2]]), 0, tolerance}, true});
  return sides;
}

void require_none_left(const Polygons& left, const Triangle& triangle, const Points& points) {
  for (const Polygon& polygon : left)
    if (const auto hole = triangulated(polygon, triangle); !hole.empty()) {
      const Vec3 at = points(Eigen::all, triangle) * hole.front().corners.rowwise().mean();
      throw input_error(
          "regions: no region holds the outer wall near ({:.4g}, {:.4g}, {:.4g}): end the list with a "
          "region "
          "without limits",
          at[0], at[1], at[2]);
    }
}

std::string named(const RegionRule& rule) {
  return rule.where.empty() ? "regions." + rule.name : rule.where;
}

/// The work, whose error is said of the rule.
auto said_of(const RegionRule& rule, auto work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw input_error("{}: {}", named(rule), error.what());
  }
}

/// Throws InputError if a point or curve lies farther from the vessel than that is long.
void require_at_hand(const Points& object, const Points& vessel) {
  const Vec3 low = vessel.rowwise().minCoeff(), high = vessel.rowwise().maxCoeff();
  const Vec3 nearest = nearest_of(object, (low + high) / 2);
  const double off = (nearest - nearest.cwiseMax(low).cwiseMin(high)).norm(), length = (high - low).norm();
  if (off > length)
    throw input_error("its point or curve lies {:.3g} from the vessel, which is {:.3g} long: is it in another unit?",
                      off, length);
}

void require_objects_at_hand(const RegionRule& rule, const Points& vessel) {
  for (const NearCurve& near : rule.near) require_at_hand(near.curve, vessel);
  if (rule.angle && rule.angle->toward.cols() > 0) require_at_hand(rule.angle->toward, vessel);
}

/// What each rule has of triangles between places at which the rules' functions are known.
class Division {
 public:
  Division(const TriangleLocator& surface, const std::vector<RegionRule>& rules, const Anatomy* anatomy)
      : rules_(rules), anatomy_(anatomy) {
    for (const RegionRule& rule : rules)
      geodesics_.push_back(said_of(rule, [&] {
        require_objects_at_hand(rule, surface.points());
        return geodesics_of(surface, rule);
      }));
  }

  /// Parts in the coordinates of the small triangles.
  std::vector<std::vector<std::vector<TrianglePart>>> shares(const SurfacePlaces& places,
                                                             const std::vector<Triangle>& between) const {
    const RuleFunctions functions(places, between, anatomy_);
    std::vector<AnyOf> ways;
    for (std::size_t i = 0; i < rules_.size(); ++i)
      ways.push_back(said_of(rules_[i], [&] { return functions.ways(rules_[i], geodesics_[i]); }));
    std::vector<std::vector<std::vector<TrianglePart>>> all;
    for (const Triangle& triangle : between) all.push_back(shares_of(triangle, ways, places.points));
    return all;
  }

 private:
  static std::vector<std::vector<TrianglePart>> shares_of(const Triangle& triangle, const std::vector<AnyOf>& rules,
                                                          const Points& points) {
    const double rounding = 1e-9 * std::sqrt(area_vector(points, triangle).norm());
    Polygons left{whole_triangle()};
    std::vector<std::vector<TrianglePart>> shares;
    for (const AnyOf& rule : rules) {
      shares.emplace_back();
      for (const AllOf& way : rule)
        for (const Polygon& polygon : taken(left, sides_on(triangle, way, rounding)))
          for (const TrianglePart& part : triangulated(polygon, triangle)) shares.back().push_back(part);
    }
    require_none_left(left, triangle, points);
    return shares;
  }

  const std::vector<RegionRule>& rules_;
  const Anatomy* anatomy_;
  std::vector<Geodesics> geodesics_;
};

bool is_whole(const std::vector<std::vector<TrianglePart>>& shares) {
  std::size_t parts = 0;
  for (const auto& share : shares) parts += share.size();
  return parts == 1;
}

/// Parts of small triangles as parts of the one that they fill.
void add_parts(std::vector<std::vector<TrianglePart>>& to, const std::vector<std::vector<TrianglePart>>& from,
               const Triangle& whole, const SurfacePlaces& places) {
  for (std::size_t rule = 0; rule < from.size(); ++rule)
    for (const TrianglePart& part : from[rule])
      to[rule].push_back({whole, places.barycentric(Eigen::all, part.of) * part.corners});
}

/// Where along the line of `along` the wall of the rule's branches lies: "its wall lies between 1.2 and 3.1 along
/// left_carotid". Empty without `along`, or where these branches have no wall.
std::string reach_along(const RegionRule& rule, const Points& points, const std::vector<Triangle>& triangles,
                        const Anatomy* anatomy) {
  if (!rule.along) return "";
  const SurfacePlaces places = nodes_as_places(points, triangles);
  RegionRule of_branches;
  of_branches.branches = rule.branches;
  const AnyOf ways = RuleFunctions(places, triangles, anatomy).ways(of_branches, {});
  const auto holds = [&](int node) {
    return std::any_of(ways.begin(), ways.end(), [&](const AllOf& all) {
      return std::all_of(all.begin(), all.end(), [&](const VectorXd& f) { return f[node] <= 0; });
    });
  };
  const std::size_t line = rule.along->branch.empty() ? 0 : anatomy->index(rule.along->branch);
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (const int node : nodes_of(triangles))
    if (holds(node)) {
      const double along = anatomy->curve(line).nearest(points.col(node)).along;
      least = std::min(least, along), most = std::max(most, along);
    }
  if (least > most) return "";
  return fmt::format("; its wall lies between {:.3g} and {:.3g} along {}", least, most, anatomy->name(line));
}

}  // namespace

std::vector<RegionRule> divided_along(const RegionRule& rule, int count, const Anatomy& anatomy) {
  AlongBranch all = rule.along.value_or(AlongBranch{rule.branches.size() == 1 ? rule.branches.front() : ""});
  const std::size_t branch = all.branch.empty() ? 0 : anatomy.index(all.branch);
  if (!rule.along) all.from = anatomy.origin(branch), all.to = anatomy.curve(branch).length();
  std::vector<RegionRule> parts;
  for (int i = 0; i < count; ++i) {
    parts.push_back(rule);
    parts.back().name = rule.name + "_" + std::to_string(i + 1);
    // without `along` the first and the last part have all before and behind: a branch begins as a saddle, not a plane
    const bool open_start = i == 0 && !rule.along;
    parts.back().along = AlongBranch{all.branch, open_start ? 0 : all.from + (all.to - all.from) * i / count,
                                     all.from + (all.to - all.from) * (i + 1) / count};
  }
  return parts;
}

std::vector<Patch> divide_by_rules(const Points& points, const std::vector<Triangle>& triangles,
                                   const std::vector<RegionRule>& rules, const Anatomy* anatomy) {
  const TriangleLocator surface(points, triangles);
  const Division division(surface, rules, anatomy);
  auto shares = division.shares(nodes_as_places(points, triangles), triangles);
  std::vector<int> cut;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (!is_whole(shares[t])) cut.push_back(static_cast<int>(t));
  const RefinedTriangles fine = refined(points, triangles, cut, pieces);
  const auto fine_shares = division.shares(fine.places, fine.parts);
  for (std::size_t i = 0; i < fine.parts.size(); ++i) {
    const auto t = static_cast<std::size_t>(cut[i / static_cast<std::size_t>(fine.parts_each)]);
    if (i % static_cast<std::size_t>(fine.parts_each) == 0) shares[t].assign(rules.size(), {});
    add_parts(shares[t], fine_shares[i], triangles[t], fine.places);
  }
  std::vector<std::string> names;
  for (const RegionRule& rule : rules) names.push_back(rule.name);
  SharedPatches shared(names);
  for (std::size_t t = 0; t < triangles.size(); ++t) shared.add(triangles[t], shares[t]);
  std::vector<Patch> patches = shared.finished();
  for (std::size_t i = 0; i < patches.size(); ++i)
    if (patches[i].triangles.empty())
      throw input_error(
          "{}: holds no triangle of the outer wall: its limits are too narrow for this mesh, or an earlier region "
          "takes "
          "all of it{}",
          named(rules[i]), reach_along(rules[i], points, triangles, anatomy));
  return patches;
}

}  // namespace tether
