#pragma once

#include <memory>
#include <vector>

#include "common/mesh/triangle_locator.hpp"
#include "vessel/anatomy/geodesic.hpp"
#include "vessel/anatomy/region_rule.hpp"
#include "vessel/anatomy/surface_places.hpp"

namespace tether {

/// The point of a curve, or of a point alone, nearest to x.
Vec3 nearest_of(const Points& curve, const Vec3& x);

/// Functions of places [length]; the condition holds where all are at most zero.
using AllOf = std::vector<VectorXd>;
/// ... where that is so for one of several.
using AnyOf = std::vector<AllOf>;

/// The rules' distances along a surface, found once: for each rule, for each of its curves.
using Geodesics = std::vector<std::unique_ptr<GeodesicDistance>>;
Geodesics geodesics_of(const TriangleLocator& surface, const RegionRule& rule);

/// What rules say of some places of a surface, by functions that are meant to be linear on triangles between them.
class RuleFunctions {
 public:
  /// anatomy: may be null where no rule speaks of branches. All must outlive this.
  RuleFunctions(const SurfacePlaces& places, const std::vector<Triangle>& between, const Anatomy* anatomy);

  /// All ways in which the rule can hold: one alternative of each of its conditions.
  AnyOf ways(const RegionRule& rule, const Geodesics& geodesics) const;

 private:
  AnyOf on_branches(const std::vector<std::string>& names) const;
  AnyOf along(const AlongBranch& range) const;
  AnyOf about(const AngleAbout& range, const std::vector<int>& places) const;
  AnyOf near(const GeodesicDistance& distance, double within) const;
  AnyOf beyond(const BeyondPlane& plane) const;
  AnyOf in(const InBox& box) const;
  std::vector<int> places_within(const std::vector<AnyOf>& conditions) const;
  std::vector<CentrelineCurve::Place> places_along(std::size_t branch) const;
  std::size_t branch(const std::string& name) const;
  VectorXd each(auto function) const;

  const SurfacePlaces& places_;
  const std::vector<Triangle>& between_;
  const Anatomy* anatomy_;
  std::vector<int> used_;
};

}  // namespace tether
