#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/mesh/patch.hpp"
#include "vessel/anatomy/anatomy.hpp"

namespace tether {

/// Between two distances along a branch's line [length], from its first point on.
struct AlongBranch {
  std::string branch;  ///< empty: the trunk
  double from = 0, to = 0;
};

/// Between two angles about a branch's line [degrees], right-handed about the flow; from a direction, or from where the
/// nearest point of an object lies.
struct AngleAbout {
  std::string branch;  ///< empty: the trunk
  double from = 0, to = 360;
  Vec3 direction = Vec3::UnitX();
  Points toward = Points(3, 0);  ///< a point, or a curve: one column a point [length]; none: `direction` counts
};

/// Within a distance along the surface of a point or curve.
struct NearCurve {
  Points curve;
  double within = 0;  ///< [length]
};

/// On the side of a plane to which its normal points.
struct BeyondPlane {
  Vec3 point, normal;
};

struct InBox {
  Vec3 low, high;
};

/// A region of a surface: all that is given must hold. Of geometry alone, so that any mesh of the surface has it.
struct RegionRule {
  std::string name;
  std::string where = {};             ///< that a user states it, for messages: "case.yaml:9: mesh.files.regions.spine"
  std::vector<std::string> branches;  ///< any of these; none: all
  std::optional<AlongBranch> along;
  std::optional<AngleAbout> angle;
  std::vector<NearCurve> near;
  std::vector<BeyondPlane> planes;
  std::optional<InBox> box;
};

/// The rule for each of `count` parts of equal length along the branch of `along` (all of it, if that is not given),
/// named NAME_1, NAME_2 ...
std::vector<RegionRule> divided_along(const RegionRule& rule, int count, const Anatomy& anatomy);

/// Patches in the order of the rules: each place is of the first that holds there. Every condition is a function of the
/// nodes, linear on each triangle, so that borders cut triangles (decision 0070) and areas converge with the square of
/// the edges. anatomy: may be null where no rule speaks of branches. Throws InputError with the place where no rule
/// holds, or with the rule that holds nowhere.
std::vector<Patch> divide_by_rules(const Points& points, const std::vector<Triangle>& triangles,
                                   const std::vector<RegionRule>& rules, const Anatomy* anatomy);

}  // namespace tether
