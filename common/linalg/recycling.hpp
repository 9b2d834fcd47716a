#pragma once

#include <utility>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// What the solves before have taught of an operator H that is near 1, but for a few directions, and changes slowly
/// from solve to solve (C.9). Of pairs x, H x that a solver computed anyway it keeps the orthonormal Q on which H - 1
/// is largest, and D = (H - 1) Q: then 1 + D Q' is near H, and its inverse a preconditioner from the right,
///   P = 1 - D (1 + Q'D)^-1 Q'.
/// Pairs of an H that has changed since cost iterations, never accuracy.
class Recycling {
 public:
  /// A solve with this right-hand side comes. What is known of other sizes is forgotten, and what it does to
  /// unknowns that are exactly zero here: they may have been free when it was learnt, and be held now.
  void begin(const VectorXd& residual);
  /// P v
  VectorXd solved(const VectorXd& v) const;
  /// y = H x was computed.
  void note(VectorXd x, VectorXd y);
  /// The solve has ended: what was noted is taken up, before what was known.
  void learn();
  void forget();
  int directions() const { return static_cast<int>(Q_.cols()); }

  /// For a checkpoint: single precision, in which Q and D are kept, two numbers in one.
  std::vector<double> packed() const;
  void unpack(const double* begin, const double* end);

 private:
  std::pair<MatrixXd, MatrixXd> pairs(Eigen::Index row, Eigen::Index rows) const;
  void prepare();

  std::vector<VectorXd> x_, y_;  ///< noted since the last `learn`
  Eigen::MatrixXf Q_, D_;
  MatrixXd inverse_;  ///< (1 + Q'D)^-1
};

}  // namespace tether
