#include "vessel/growth/thickness.hpp"

#include <algorithm>

namespace tether {

namespace {

/// 0 before 0, 1 behind 1, with zero slope at both.
double smooth_step(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

std::vector<Thickness> by_branch(const TreeThickness& thickness, const Anatomy& anatomy) {
  std::vector<Thickness> each(anatomy.size(), thickness.everywhere);
  for (const auto& [name, own] : thickness.branches) each[anatomy.index(name)] = own;
  return each;
}

/// Over which way each branch's weight changes: about a junction with its parent or with a branch of its own.
VectorXd blending_ways(const TreeThickness& thickness, const Anatomy& anatomy) {
  VectorXd ways(static_cast<Eigen::Index>(anatomy.size()));
  for (std::size_t i = 0; i < anatomy.size(); ++i)
    ways[static_cast<Eigen::Index>(i)] = thickness.blend.value_or(anatomy.curve(i).at(anatomy.origin(i)).radius);
  return ways;
}

/// (M.5)
VectorXd weights(const VectorXd& outside, const VectorXd& ways) {
  VectorXd result = VectorXd::Ones(outside.size());
  for (Eigen::Index i = 0; i < outside.size(); ++i)
    for (Eigen::Index j = 0; j < outside.size(); ++j)
      if (i != j) result[i] *= smooth_step(0.5 - (outside[i] - outside[j]) / std::min(ways[i], ways[j]));
  return result / result.sum();
}

}  // namespace

VectorXd thickness_at(const Points& places, const TreeThickness& thickness, const Anatomy& anatomy) {
  const std::vector<Thickness> each = by_branch(thickness, anatomy);
  const VectorXd ways = blending_ways(thickness, anatomy);
  VectorXd result = VectorXd::Zero(places.cols());
  for (Eigen::Index i = 0; i < places.cols(); ++i) {
    const Vec3 x = places.col(i);
    const VectorXd weight = weights(anatomy.outside(x), ways);
    for (std::size_t branch = 0; branch < anatomy.size(); ++branch) {
      const double share = weight[static_cast<Eigen::Index>(branch)];
      if (share == 0) continue;
      const Thickness& own = each[branch];
      result[i] += share * (own.length ? *own.length
                                       : own.fraction_of_radius.value_or(0) *
                                             anatomy.curve(branch).nearest(x, anatomy.origin(branch)).radius);
    }
  }
  return result;
}

}  // namespace tether
