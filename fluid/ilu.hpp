#pragma once

#include "common/base/types.hpp"
#include "common/linalg/sparse.hpp"

namespace tether {

/// Incomplete LU factors on the matrix's own pattern, ILU(0). (Eigen's IncompleteLUT sorts and drops: several times
/// slower to set up.)
class Ilu0 {
 public:
  /// Throws RunError on a zero pivot.
  void factor(const SparseMatrix& matrix);
  /// x <- U^-1 L^-1 x for three right-hand sides at once: column i of x holds the three values of unknown i.
  void solve_in_place(Points& x) const;

 private:
  SparseMatrix factors_;       // strictly lower part: L (unit diagonal); rest: U, its diagonal inverted
  std::vector<int> diagonal_;  // position of each row's diagonal entry
};

}  // namespace tether
