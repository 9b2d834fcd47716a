#include "vessel/anatomy/anatomy.hpp"

#include <algorithm>
#include <limits>

#include "common/base/error.hpp"

namespace tether {

namespace {

/// Where the line comes out of the parent's lumen.
double origin_on(const CentrelineCurve& parent, const CentrelineCurve& curve, const std::string& name) {
  const auto outside = [&](double along) {
    const auto place = parent.nearest(curve.at(along).centre);
    return place.distance - place.radius;
  };
  constexpr int steps = 200;
  for (int i = 0; i < steps; ++i) {
    double inner = curve.length() * i / steps, outer = curve.length() * (i + 1) / steps;
    if (i == 0 && outside(inner) > 0) return 0;
    if (outside(outer) < 0) continue;
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = (inner + outer) / 2;
      (outside(middle) < 0 ? inner : outer) = middle;
    }
    return outer;
  }
  throw input_error("centreline {}: lies within its parent's lumen all along", name);
}

}  // namespace

Anatomy::Anatomy(const CentrelineTree& tree) {
  for (std::size_t i = 0; i < tree.branches.size(); ++i) {
    const Branch& branch = tree.branches[i];
    if (branch.parent >= static_cast<int>(i))
      throw input_error("centreline {}: its parent must stand before it", branch.name);
    if (std::find(names_.begin(), names_.end(), branch.name) != names_.end())
      throw input_error("centreline {}: two branches have this name", branch.name);
    names_.push_back(branch.name);
    curves_.emplace_back(branch.points, branch.radii, branch.name);
    origins_.push_back(branch.parent < 0
                           ? 0
                           : origin_on(curves_[static_cast<std::size_t>(branch.parent)], curves_.back(), branch.name));
  }
  if (curves_.empty()) throw input_error("centreline: has no branch");
}

std::size_t Anatomy::index(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end())
    throw input_error("the centreline has no branch '{}'; it has {}", name, fmt::join(names_, ", "));
  return static_cast<std::size_t>(found - names_.begin());
}

VectorXd Anatomy::outside(const Vec3& x) const {
  VectorXd result(static_cast<Eigen::Index>(size()));
  for (std::size_t i = 0; i < size(); ++i) {
    const auto place = curves_[i].nearest(x, origins_[i]);
    result[static_cast<Eigen::Index>(i)] = place.distance - place.radius;  // (M.4)
  }
  return result;
}

double beyond_branch(const VectorXd& outside, std::size_t branch) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < outside.size(); ++i)
    if (i != static_cast<Eigen::Index>(branch)) least = std::min(least, outside[i]);
  return outside.size() > 1 ? outside[static_cast<Eigen::Index>(branch)] - least : -1;
}

}  // namespace tether
