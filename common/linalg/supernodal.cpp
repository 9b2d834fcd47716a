#include "common/linalg/supernodal.hpp"

#include <cblas.h>
#include <cholmod.h>
#include <omp.h>

#include <algorithm>
#include <cstring>

#include "common/base/error.hpp"
#include "common/linalg/blas_kernels.hpp"

namespace tether {
namespace {

void triangle(CBLAS_TRANSPOSE transposed, const Supernode<float>& node, float* x) {
  cblas_strsv(CblasColMajor, CblasLower, transposed, CblasNonUnit, node.columns, node.triangle, node.height, x, 1);
}
void triangle(CBLAS_TRANSPOSE transposed, const Supernode<double>& node, double* x) {
  cblas_dtrsv(CblasColMajor, CblasLower, transposed, CblasNonUnit, node.columns, node.triangle, node.height, x, 1);
}
/// y <- scale A x + keep y, A what is below the triangle.
void below(CBLAS_TRANSPOSE transposed, const Supernode<float>& node, float scale, const float* x, float keep,
           float* y) {
  cblas_sgemv(CblasColMajor, transposed, node.below(), node.columns, scale, node.rectangle, node.height, x, 1, keep, y,
              1);
}
void below(CBLAS_TRANSPOSE transposed, const Supernode<double>& node, double scale, const double* x, double keep,
           double* y) {
  cblas_dgemv(CblasColMajor, transposed, node.below(), node.columns, scale, node.rectangle, node.height, x, 1, keep, y,
              1);
}

}  // namespace

void prepare_cholmod(cholmod_common& common) {
  prepare_blas();
  omp_set_max_active_levels(
      0);  // CHOLMOD asks for four threads whatever the environment says; they spin, and cost 40 % CPU
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

void RoundedValues::take(cholmod_factor& factor) {
  drop();
  const std::size_t size = factor.xsize;
  values_ = static_cast<float*>(factor.x);
  for (std::size_t i = 0; i < size; ++i) {
    double value = 0;
    std::memcpy(&value, static_cast<const double*>(factor.x) + i, sizeof value);
    const auto single = static_cast<float>(value);
    std::memcpy(values_ + i, &single, sizeof single);
  }
  room_ = size;
  values_ = static_cast<float*>(cholmod_realloc(size / 2 + 1, 8, factor.x, &room_, &common_));
  factor.x = nullptr;  // as cholmod_change_factor leaves it, which would have freed the values
  factor.xtype = CHOLMOD_PATTERN;
}

void RoundedValues::drop() {
  values_ = static_cast<float*>(cholmod_free(room_, 8, values_, &common_));
  room_ = 0;
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

template <class Scalar>
Supernode<Scalar>::Supernode(const cholmod_factor& factor, const Scalar* values, std::size_t s) {
  const int* super = static_cast<const int*>(factor.super) + s;
  const int* place = static_cast<const int*>(factor.pi) + s;
  first = super[0];
  columns = super[1] - super[0];
  height = place[1] - place[0];
  rows = static_cast<const int*>(factor.s) + place[0] + columns;
  triangle = values + static_cast<const int*>(factor.px)[s];
  rectangle = triangle + columns;
}

template <class Scalar>
void solve_forward(const cholmod_factor& factor, const Scalar* values, int end, Scalar* x, Scalar* other) {
  for (std::size_t k = 0; k < factor.nsuper && static_cast<const int*>(factor.super)[k] < end; ++k) {
    const Supernode node = Supernode<Scalar>(factor, values, k).before(end);
    triangle(CblasNoTrans, node, x + node.first);
    if (node.below() == 0) continue;
    below(CblasNoTrans, node, 1, x + node.first, 0, other);
    for (int i = 0; i < node.below(); ++i) x[node.rows[i]] -= other[i];
  }
}

template <class Scalar>
void solve_backward(const cholmod_factor& factor, const Scalar* values, int end, Scalar* x, Scalar* other) {
  for (std::size_t k = factor.nsuper; k-- > 0;) {
    if (static_cast<const int*>(factor.super)[k] >= end) continue;
    const Supernode node = Supernode<Scalar>(factor, values, k).before(end);
    for (int i = 0; i < node.below(); ++i) other[i] = x[node.rows[i]];
    if (node.below() > 0) below(CblasTrans, node, -1, other, 1, x + node.first);
    triangle(CblasTrans, node, x + node.first);
  }
}

template struct Supernode<float>;
template struct Supernode<double>;
template void solve_forward(const cholmod_factor&, const float*, int, float*, float*);
template void solve_forward(const cholmod_factor&, const double*, int, double*, double*);
template void solve_backward(const cholmod_factor&, const float*, int, float*, float*);
template void solve_backward(const cholmod_factor&, const double*, int, double*, double*);

}  // namespace tether
