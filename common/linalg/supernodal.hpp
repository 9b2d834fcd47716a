#pragma once

// Only for this folder's .cpp files: what is done with CHOLMOD's supernodal factors.
#include <cstddef>
#include <vector>

#include "common/linalg/sparse.hpp"

using cholmod_common = struct cholmod_common_struct;
using cholmod_factor = struct cholmod_factor_struct;
using cholmod_sparse = struct cholmod_sparse_struct;

namespace tether {

/// As the project wants it: supernodal, L L', one thread, silent.
void prepare_cholmod(cholmod_common& common);

/// A symmetric row-major matrix read as compressed columns; CHOLMOD then uses its upper half only.
cholmod_sparse view_of(const SparseMatrix& matrix);

/// A fill-reducing order of all unknowns from one of the nodes: METIS on a graph components^2 times smaller. Throws
/// RunError.
std::vector<int> order_by_nodes(const SparseMatrix& matrix, int components, cholmod_common& common);

/// A supernodal factor's values in single precision, instead of its own.
class RoundedValues {
 public:
  explicit RoundedValues(cholmod_common& common) : common_(common) {}
  ~RoundedValues() { drop(); }
  RoundedValues(const RoundedValues&) = delete;
  RoundedValues& operator=(const RoundedValues&) = delete;

  /// In place: nothing more is needed than the factor takes, and half of that is given back. The factor keeps its
  /// pattern.
  void take(cholmod_factor& factor);
  void drop();

  bool is_empty() const { return values_ == nullptr; }
  const float* data() const { return values_; }

 private:
  cholmod_common& common_;
  float* values_ = nullptr;
  std::size_t room_ = 0;  ///< in doubles
};

/// Some columns of a supernodal factor that have the same rows: a dense block, the triangle of the columns' own rows
/// above the others.
template <class Scalar>
struct Supernode {
  /// values: of the factor.
  Supernode(const cholmod_factor& factor, const Scalar* values, std::size_t s);
  /// The same, without the columns from `end` on.
  Supernode before(int end) const {
    Supernode part = *this;
    if (first + columns <= end) return part;
    part.columns = end - first;
    part.rows = rows - (columns - part.columns);
    part.rectangle = triangle + part.columns;
    return part;
  }

  int first, columns, height;
  const int* rows;  ///< of what is below the triangle
  const Scalar *triangle, *rectangle;
  int below() const { return height - columns; }
};

/// The factor's columns before `end`: x <- L^-1 x; what stands below them is subtracted from the rest of x. `other`:
/// room for as many numbers as a column of the tallest supernode has.
template <class Scalar>
void solve_forward(const cholmod_factor& factor, const Scalar* values, int end, Scalar* x, Scalar* other);
/// The same columns: x <- L'^-1 x, where the rest of x is known.
template <class Scalar>
void solve_backward(const cholmod_factor& factor, const Scalar* values, int end, Scalar* x, Scalar* other);

}  // namespace tether
