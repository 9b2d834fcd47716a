#pragma once

#include <deque>
#include <vector>

#include "common/base/types.hpp"

namespace tether {

/// What IQN-ILS remembers: pairs of differences (dR, dX) between consecutive evaluations of x~ = S(F(x)), r = x~ - x,
/// of this step and some earlier ones, newest first.
class DifferenceColumns {
 public:
  /// `reuse`: earlier steps kept. `filter`: a column of dR is dropped if less than this share of it is new to the
  /// columns before it (Haelterman et al. 2016, QR filter).
  DifferenceColumns(int reuse, double filter) : reuse_(reuse), filter_(filter) {}

  void begin_step();
  void add(VectorXd dR, VectorXd dX);
  void forget() { steps_.clear(); }
  bool empty() const;
  /// dX c with c = argmin |r + dR c|. Drops the columns that the filter finds dependent.
  VectorXd correction(const VectorXd& residual);

  /// All columns as one array, for a checkpoint.
  std::vector<double> packed() const;
  void unpack(const double* begin, const double* end);

 private:
  struct Pair {
    VectorXd dR, dX;
  };
  int reuse_;
  double filter_;
  std::deque<std::deque<Pair>> steps_;  // newest step first, newest pair first
};

}  // namespace tether
