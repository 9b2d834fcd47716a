#pragma once

#include <random>

#include "common/base/types.hpp"

/// Derivatives by differences, against which tests hold the coded ones.
namespace tether {

/// d f(t)/dt at t = 0 of a scalar, vector or matrix function: central differences, Richardson-extrapolated, error
/// O(h^4).
template <class Function>
auto derivative(const Function& f, double h) {
  using Value = std::decay_t<decltype(f(h))>;
  const Value a = f(h), b = f(-h), c = f(2 * h), d = f(-2 * h);
  return Value((8 * (a - b) - (c - d)) / (12 * h));
}

/// Numbers between -1 and 1, the same in every run.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double operator()() { return distribution_(engine_); }
  Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [this] { return (*this)(); });
  }

 private:
  std::mt19937 engine_;
  std::uniform_real_distribution<double> distribution_{-1.0, 1.0};
};

}  // namespace tether
