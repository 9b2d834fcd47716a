#include "vessel/anatomy/conditions.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.hpp"
#include "common/mesh/mesh.hpp"

namespace tether {

namespace {

/// Where angle zero is at a place of a line, in its cross-section.
Vec3 zero_direction(const AngleAbout& about, const CentrelineCurve::Place& at) {
  const Vec3 wanted = about.toward.cols() > 0 ? Vec3(nearest_of(about.toward, at.centre) - at.centre) : about.direction;
  const Vec3 within = wanted - at.tangent * at.tangent.dot(wanted);
  if (!(within.norm() > 0.1 * wanted.norm()))
    throw input_error(
        "angle zero is not known near ({:.4g}, {:.4g}, {:.4g}): the direction of angle zero runs along the vessel "
        "there; limit the region along the vessel, or give another direction or an object",
        at.centre[0], at.centre[1], at.centre[2]);
  return within.normalized();
}

/// One alternative of each condition, in all ways.
AnyOf combined(const std::vector<AnyOf>& conditions) {
  AnyOf ways{AllOf{}};
  for (const AnyOf& condition : conditions) {
    AnyOf longer;
    for (const AllOf& begun : ways)
      for (const AllOf& alternative : condition) {
        longer.push_back(begun);
        longer.back().insert(longer.back().end(), alternative.begin(), alternative.end());
      }
    ways = std::move(longer);
  }
  return ways;
}

}  // namespace

Vec3 nearest_of(const Points& curve, const Vec3& x) {
  Vec3 best = curve.col(0);
  for (Eigen::Index i = 1; i < curve.cols(); ++i) {
    const Vec3 from = curve.col(i - 1), way = curve.col(i) - from;
    const double length = way.squaredNorm(), t = length > 0 ? std::clamp((x - from).dot(way) / length, 0.0, 1.0) : 0;
    if (const Vec3 here = from + t * way; (here - x).norm() < (best - x).norm()) best = here;
  }
  return best;
}

Geodesics geodesics_of(const TriangleLocator& surface, const RegionRule& rule) {
  Geodesics geodesics;
  for (const NearCurve& curve : rule.near)
    geodesics.push_back(std::make_unique<GeodesicDistance>(surface, curve.curve, curve.within));
  return geodesics;
}

RuleFunctions::RuleFunctions(const SurfacePlaces& places, const std::vector<Triangle>& between, const Anatomy* anatomy)
    : places_(places), between_(between), anatomy_(anatomy), used_(nodes_of(between)) {}

VectorXd RuleFunctions::each(auto function) const {
  VectorXd values = VectorXd::Zero(places_.points.cols());
  for (const int place : used_) values[place] = function(place);
  return values;
}

std::size_t RuleFunctions::branch(const std::string& name) const {
  if (!anatomy_) throw input_error("needs the centreline: give mesh.files.centreline");
  return name.empty() ? 0 : anatomy_->index(name);
}

/// Less far outside this branch than each other one: linear pieces that leave no gap where three meet.
AnyOf RuleFunctions::on_branches(const std::vector<std::string>& names) const {
  if (!anatomy_) branch({});
  MatrixXd outside(static_cast<Eigen::Index>(anatomy_->size()), places_.points.cols());
  for (const int place : used_) outside.col(place) = anatomy_->outside(places_.points.col(place));
  AnyOf any;
  for (const std::string& name : names) {
    const auto own = static_cast<Eigen::Index>(branch(name));
    any.emplace_back();
    for (Eigen::Index other = 0; other < outside.rows(); ++other)
      if (other != own)
        any.back().push_back(each([&](int place) { return outside(own, place) - outside(other, place); }));
  }
  return any;
}

std::vector<CentrelineCurve::Place> RuleFunctions::places_along(std::size_t branch) const {
  std::vector<CentrelineCurve::Place> places(static_cast<std::size_t>(places_.points.cols()));
  for (const int place : used_)
    places[static_cast<std::size_t>(place)] = anatomy_->curve(branch).nearest(places_.points.col(place));
  return places;
}

/// Beyond its ends a line counts as going on, so that limits at them leave nothing out.
AnyOf RuleFunctions::along(const AlongBranch& range) const {
  const std::size_t number = branch(range.branch);
  const std::vector<CentrelineCurve::Place> places = places_along(number);
  const auto at = [&](int place) { return places[static_cast<std::size_t>(place)].along; };
  AllOf all;
  if (range.from > 0) all.push_back(each([&](int place) { return range.from - at(place); }));
  if (range.to < anatomy_->curve(number).length() * (1 - 1e-9))
    all.push_back(each([&](int place) { return at(place) - range.to; }));
  return AnyOf{all};
}

/// A sector of at most half a turn lies between two half planes; a larger one is two of them.
AnyOf RuleFunctions::about(const AngleAbout& range, const std::vector<int>& among) const {
  const double turn = range.to - range.from + (range.to < range.from ? 360 : 0);
  if (turn >= 360) return AnyOf{AllOf{}};
  const std::vector<CentrelineCurve::Place> places = places_along(branch(range.branch));
  // distance to the half plane at an angle, positive at larger angles
  const auto ahead_of = [&](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    VectorXd ahead = VectorXd::Zero(places_.points.cols());
    for (const int place : among) {
      const CentrelineCurve::Place& at = places[static_cast<std::size_t>(place)];
      const Vec3 arm = places_.points.col(place) - at.centre, zero = zero_direction(range, at);
      ahead[place] = arm.dot(std::cos(angle) * at.tangent.cross(zero) - std::sin(angle) * zero);
    }
    return ahead;
  };
  const auto sector = [&](double from, double to) { return AllOf{-ahead_of(from), ahead_of(to)}; };
  if (turn <= 180) return AnyOf{sector(range.from, range.from + turn)};
  const double middle = range.from + turn / 2;
  return {sector(range.from, middle), sector(middle, range.from + turn)};
}

/// Corners of the triangles on which the conditions hold somewhere, or might.
std::vector<int> RuleFunctions::places_within(const std::vector<AnyOf>& conditions) const {
  const auto holds_somewhere = [](const VectorXd& function, const Triangle& t) {
    return function[t[0]] <= 0 || function[t[1]] <= 0 || function[t[2]] <= 0;
  };
  std::vector<Triangle> within;
  for (const Triangle& t : between_) {
    const auto all_hold = [&](const AllOf& all) {
      return std::all_of(all.begin(), all.end(), [&](const VectorXd& f) { return holds_somewhere(f, t); });
    };
    if (std::all_of(conditions.begin(), conditions.end(),
                    [&](const AnyOf& any) { return std::any_of(any.begin(), any.end(), all_hold); }))
      within.push_back(t);
  }
  return nodes_of(within);
}

AnyOf RuleFunctions::near(const GeodesicDistance& distance, double within) const {
  return AnyOf{AllOf{each([&](int place) {
    return distance.at(places_.triangle[static_cast<std::size_t>(place)], places_.barycentric.col(place)) - within;
  })}};
}

AnyOf RuleFunctions::beyond(const BeyondPlane& plane) const {
  const Vec3 normal = plane.normal.normalized();
  return AnyOf{AllOf{each([&](int place) { return normal.dot(plane.point - places_.points.col(place)); })}};
}

AnyOf RuleFunctions::in(const InBox& box) const {
  AllOf all;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    all.push_back(each([&](int place) { return box.low[axis] - places_.points(axis, place); }));
    all.push_back(each([&](int place) { return places_.points(axis, place) - box.high[axis]; }));
  }
  return AnyOf{all};
}

AnyOf RuleFunctions::ways(const RegionRule& rule, const Geodesics& geodesics) const {
  std::vector<AnyOf> conditions;
  if (!rule.branches.empty()) conditions.push_back(on_branches(rule.branches));
  if (rule.along) conditions.push_back(along(*rule.along));
  for (std::size_t i = 0; i < rule.near.size(); ++i) conditions.push_back(near(*geodesics[i], rule.near[i].within));
  for (const BeyondPlane& plane : rule.planes) conditions.push_back(beyond(plane));
  if (rule.box) conditions.push_back(in(*rule.box));
  // angles are asked for only where the rest may hold: elsewhere they need not exist
  if (rule.angle) conditions.push_back(about(*rule.angle, places_within(conditions)));
  return combined(conditions);
}

}  // namespace tether
