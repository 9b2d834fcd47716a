#pragma once

// Only for this folder's .cpp files: what is done with CHOLMOD's supernodal factors.
#include <cstddef>
#include <vector>

using cholmod_common = struct cholmod_common_struct;
using cholmod_factor = struct cholmod_factor_struct;

namespace tether {

/// A supernodal factor in single precision, to precondition with: half of what each solve has to read.
///
/// Each supernode is a product of panels of at most `widest` columns, and of a panel's triangle T and what stands below
/// it, B, what is kept is T^-1 above -B T^-1: both ways through it are one product with a dense matrix, where solves
/// with narrow triangles would take as long again. The triangles are as well conditioned as the matrix's own small
/// blocks, and inverted before they are rounded.
class RoundedFactor {
 public:
  explicit RoundedFactor(cholmod_common& common) : common_(common) {}
  ~RoundedFactor() { drop(); }
  RoundedFactor(const RoundedFactor&) = delete;
  RoundedFactor& operator=(const RoundedFactor&) = delete;

  /// Of the columns before `end`, instead of the factor's own values and in their place: no more memory is needed than
  /// these take, and half of it is given back. The factor keeps its pattern.
  void take(cholmod_factor& factor, int end);
  void drop();

  bool is_empty() const { return values_ == nullptr; }
  double megabytes() const { return 4e-6 * static_cast<double>(size_); }

  /// x <- L^-1 x of those columns; what stands below them is subtracted from the rest of x, all numbers of which follow
  /// in the factor's order.
  void solve_forward(float* x) const;
  /// The same columns: x <- L'^-1 x, where the rest of x is known.
  void solve_backward(float* x) const;

 private:
  struct Panels {
    int first, columns, height;
    const int* rows;     ///< of what is below the columns
    std::size_t values;  ///< where the first panel begins
  };

  cholmod_common& common_;
  std::vector<Panels> supernodes_;
  std::vector<int> rows_;
  float* values_ = nullptr;
  std::size_t size_ = 0;  ///< in numbers
  std::size_t room_ = 0;  ///< in doubles
  mutable std::vector<float> column_;
};

}  // namespace tether
