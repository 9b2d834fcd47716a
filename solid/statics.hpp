#pragma once

#include <functional>
#include <vector>

#include "solid/elements/wall_elements.hpp"

namespace tether {

/// Forces on the wall at given positions; adds d(-force)/dx to `tangent` if not null (zero for dead loads).
using StaticLoad = std::function<void(const Points& x, VectorXd& force, SparseMatrix* tangent)>;

struct StaticResult {
  bool converged = false;
  int iterations = 0;
  double residual = 0;  ///< largest out-of-balance force relative to the largest load
  Points positions;
};

/// Equilibrium f_int(x) = load(x) by Newton from `start`; `fixed`: unknowns (3 node + component) that keep their start
/// value. Each iteration factors the tangent. Not converging is a result.
StaticResult solve_static(const WallElements& wall, const Material& material, const Points& start,
                          const StaticLoad& load, const std::vector<int>& fixed, double tolerance = 1e-10,
                          int max_iterations = 30);

}  // namespace tether
