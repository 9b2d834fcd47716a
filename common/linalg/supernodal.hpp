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

/// Some columns of a supernodal factor that have the same rows: a dense block, the triangle of the columns' own rows
/// above the others.
struct Supernode {
  Supernode(const cholmod_factor& factor, std::size_t s);
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
  const double *triangle, *rectangle;
  int below() const { return height - columns; }
};

/// The factor's columns before `end`: x <- L^-1 x; what stands below them is subtracted from the rest of x. `other`:
/// room for as many numbers as a column of the tallest supernode has.
void solve_forward(const cholmod_factor& factor, int end, double* x, double* other);
/// The same columns: x <- L'^-1 x, where the rest of x is known.
void solve_backward(const cholmod_factor& factor, int end, double* x, double* other);

}  // namespace tether
