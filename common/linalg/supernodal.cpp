#include "common/linalg/supernodal.hpp"

#include <cblas.h>
#include <cholmod.h>

#include <algorithm>

#include "common/base/error.hpp"
#include "common/linalg/blas_kernels.hpp"

/// What GCC makes of `#pragma omp parallel`, here for the libraries that the program is linked with: one thread, and
/// nothing else. CHOLMOD has such a loop for each pair of supernodes, and asks for four threads whatever the
/// environment says; they would spin, and OpenMP's own team of one thread costs a system call each time: a sixth of the
/// blood's time.
extern "C" void GOMP_parallel(void (*body)(void*), void* data, unsigned /*threads*/, unsigned /*flags*/) {
  body(data);
}

namespace tether {
namespace {

void triangle(CBLAS_TRANSPOSE transposed, const Supernode& node, double* x) {
  cblas_dtrsv(CblasColMajor, CblasLower, transposed, CblasNonUnit, node.columns, node.triangle, node.height, x, 1);
}
/// y <- scale A x + keep y, A what is below the triangle.
void below(CBLAS_TRANSPOSE transposed, const Supernode& node, double scale, const double* x, double keep, double* y) {
  cblas_dgemv(CblasColMajor, transposed, node.below(), node.columns, scale, node.rectangle, node.height, x, 1, keep, y,
              1);
}

}  // namespace

void prepare_cholmod(cholmod_common& common) {
  prepare_blas();
  cholmod_start(&common);
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.final_ll = 1;
  common.print = 0;
}

cholmod_sparse view_of(const SparseMatrix& matrix) {
  cholmod_sparse result{};
  result.nrow = result.ncol = static_cast<std::size_t>(matrix.rows());
  result.nzmax = static_cast<std::size_t>(matrix.nonZeros());
  result.p = const_cast<int*>(matrix.outerIndexPtr());
  result.i = const_cast<int*>(matrix.innerIndexPtr());
  result.x = const_cast<double*>(matrix.valuePtr());
  result.stype = 1;
  result.itype = CHOLMOD_INT;
  result.xtype = CHOLMOD_REAL;
  result.dtype = CHOLMOD_DOUBLE;
  result.sorted = 1;
  result.packed = 1;
  return result;
}

std::vector<int> order_by_nodes(const SparseMatrix& matrix, int components, cholmod_common& common) {
  const int nodes = static_cast<int>(matrix.rows()) / components;
  std::vector<int> start(static_cast<std::size_t>(nodes) + 1, 0), index;
  for (int node = 0; node < nodes; ++node) {
    for (SparseMatrix::InnerIterator entry(matrix, node * components); entry; ++entry)
      if (entry.col() % components == 0) index.push_back(static_cast<int>(entry.col()) / components);
    start[static_cast<std::size_t>(node) + 1] = static_cast<int>(index.size());
  }
  cholmod_sparse graph{};
  graph.nrow = graph.ncol = static_cast<std::size_t>(nodes);
  graph.nzmax = index.size();
  graph.p = start.data();
  graph.i = index.data();
  graph.stype = 1;
  graph.itype = CHOLMOD_INT;
  graph.xtype = CHOLMOD_PATTERN;
  graph.sorted = 1;
  graph.packed = 1;
  std::vector<int> node_order(static_cast<std::size_t>(nodes)), order;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_METIS;
  common.postorder = 1;
  cholmod_factor* symbolic = cholmod_analyze(&graph, &common);
  if (symbolic == nullptr) throw run_error("the ordering of a sparse matrix failed (CHOLMOD status {})", common.status);
  const int* permutation = static_cast<const int*>(symbolic->Perm);
  std::copy_n(permutation, nodes, node_order.begin());
  cholmod_free_factor(&symbolic, &common);
  order.reserve(static_cast<std::size_t>(matrix.rows()));
  for (int node : node_order)
    for (int c = 0; c < components; ++c) order.push_back(node * components + c);
  return order;
}

Supernode::Supernode(const cholmod_factor& factor, std::size_t s) {
  const int* super = static_cast<const int*>(factor.super) + s;
  const int* place = static_cast<const int*>(factor.pi) + s;
  first = super[0];
  columns = super[1] - super[0];
  height = place[1] - place[0];
  rows = static_cast<const int*>(factor.s) + place[0] + columns;
  triangle = static_cast<const double*>(factor.x) + static_cast<const int*>(factor.px)[s];
  rectangle = triangle + columns;
}

void solve_forward(const cholmod_factor& factor, int end, double* x, double* other) {
  for (std::size_t k = 0; k < factor.nsuper && static_cast<const int*>(factor.super)[k] < end; ++k) {
    const Supernode node = Supernode(factor, k).before(end);
    triangle(CblasNoTrans, node, x + node.first);
    if (node.below() == 0) continue;
    below(CblasNoTrans, node, 1, x + node.first, 0, other);
    for (int i = 0; i < node.below(); ++i) x[node.rows[i]] -= other[i];
  }
}

void solve_backward(const cholmod_factor& factor, int end, double* x, double* other) {
  for (std::size_t k = factor.nsuper; k-- > 0;) {
    if (static_cast<const int*>(factor.super)[k] >= end) continue;
    const Supernode node = Supernode(factor, k).before(end);
    for (int i = 0; i < node.below(); ++i) other[i] = x[node.rows[i]];
    if (node.below() > 0) below(CblasTrans, node, -1, other, 1, x + node.first);
    triangle(CblasTrans, node, x + node.first);
  }
}

}  // namespace tether
