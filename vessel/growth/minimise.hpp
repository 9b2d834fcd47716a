#pragma once

#include <functional>

#include "common/base/types.hpp"

namespace tether {

/// A function's value at x; writes its gradient.
using Differentiable = std::function<double(const VectorXd& x, VectorXd& gradient)>;

struct Minimum {
  VectorXd x;
  double value;
  int evaluations;
};

/// Descends from x by L-BFGS (Nocedal and Wright, Numerical Optimization, algorithms 7.4 and 7.5) with step lengths
/// that fulfil Armijo's condition, until a step gains less than `tolerance` of the value, or after so many steps.
Minimum minimise(const Differentiable& function, VectorXd x, int steps, double tolerance = 1e-5);

}  // namespace tether
