#pragma once

#include "common/linalg/recycling.hpp"
#include "fsi_master/gmres.hpp"

namespace tether {

/// GMRES for a sequence of operators, each near the one before: preconditioned from the right by what earlier solves
/// have taught (C.9), so that it stops on the same |residual|; then it is a lesson itself. Adds the solution to x.
template <class Apply>
KrylovResult recycled_gmres(const Apply& apply, const VectorXd& residual, VectorXd& x, double target,
                            int max_iterations, Recycling& known) {
  known.begin(residual);
  VectorXd v = VectorXd::Zero(residual.size());
  const auto from_the_right = [&](const VectorXd& direction) {
    VectorXd moved = known.solved(direction), image = apply(moved);
    known.note(std::move(moved), image);
    return image;
  };
  const KrylovResult result = gmres(from_the_right, residual, v, target, max_iterations);
  x += known.solved(v);
  known.learn();
  return result;
}

}  // namespace tether
