#pragma once

#include <string>
#include <vector>

#include "vessel/anatomy/centreline_curve.hpp"
#include "vessel/centreline/tree.hpp"

namespace tether {

/// A tree of vessels as smooth curves with radii: which branch a place belongs to, and where about it.
class Anatomy {
 public:
  /// Throws InputError naming the branch: no points, a parent that does not stand before it, a branch that never leaves
  /// its parent's lumen, a name used twice.
  explicit Anatomy(const CentrelineTree& tree);

  std::size_t size() const { return curves_.size(); }
  /// Throws InputError that lists the names that there are.
  std::size_t index(const std::string& name) const;
  const std::string& name(std::size_t branch) const { return names_[branch]; }
  const CentrelineCurve& curve(std::size_t branch) const { return curves_[branch]; }
  /// Along the branch's line, where it comes out of its parent's lumen; 0 for the trunk [length].
  double origin(std::size_t branch) const { return origins_[branch]; }

  /// How far outside each branch's lumen: distance to its line less its radius there [length] (M.4). The part of a line
  /// that lies in its parent's lumen does not count.
  VectorXd outside(const Vec3& x) const;

 private:
  std::vector<std::string> names_;
  std::vector<CentrelineCurve> curves_;
  std::vector<double> origins_;
};

/// Less than zero where the place belongs to `branch`: it is farther outside every other one; near a junction, about
/// the distance to it [length].
double beyond_branch(const VectorXd& outside, std::size_t branch);

}  // namespace tether
