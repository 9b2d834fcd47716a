#include "common/linalg/cholesky.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <string>

#include "common/base/error.hpp"
#include "common/linalg/blas_kernels.hpp"
#include "tests/io/less_memory.hpp"
#include "tests/sanitizers/built_with.hpp"

namespace tether {
namespace {

/// Finite differences of the Laplacian on n x n x n points.
SparseMatrix laplacian(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  const int stride[3] = {1, n, n * n};
  for (int i = 0; i < n * n * n; ++i) {
    entries.emplace_back(i, i, 6.0);
    for (int axis = 0; axis < 3; ++axis)
      if (i / stride[axis] % n + 1 < n) {
        entries.emplace_back(i, i + stride[axis], -1.0);
        entries.emplace_back(i + stride[axis], i, -1.0);
      }
  }
  SparseMatrix matrix(n * n * n, n * n * n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST(Cholesky, SolvesForOneAndForSeveral) {
  const SparseMatrix matrix = laplacian(12);
  Cholesky cholesky;
  cholesky.factor(matrix);
  const Eigen::MatrixXd exact = Eigen::MatrixXd::Random(matrix.rows(), 3);
  Eigen::MatrixXd x = matrix * exact;
  cholesky.solve_in_place(x);
  EXPECT_LT((x - exact).norm(), 1e-12 * exact.norm());
  EXPECT_LT((cholesky.solve(matrix * exact.col(1)) - exact.col(1)).norm(), 1e-12 * exact.norm());
}

TEST(Cholesky, RoundedToSingleItSolvesAlmostAsWellInHalfTheMemory) {
  const SparseMatrix matrix = laplacian(12);
  Cholesky cholesky;
  cholesky.factor(matrix);
  const double whole = cholesky.factor_megabytes();
  ASSERT_TRUE(cholesky.factor_roughly(matrix, 1e-3));
  EXPECT_TRUE(cholesky.has_factor());
  EXPECT_LE(cholesky.factor_megabytes(), whole / 2);  // the upper triangles of its blocks are left out
  EXPECT_GT(cholesky.factor_megabytes(), whole / 4);
  const Eigen::MatrixXd exact = Eigen::MatrixXd::Random(matrix.rows(), 2);
  for (const double size : {1.0, 1e-60, 1e60}) {  // beyond the range of single precision
    Eigen::MatrixXd x = size * (matrix * exact);
    cholesky.solve_in_place(x);
    EXPECT_LT((x - size * exact).norm(), 3e-6 * size * exact.norm());
    EXPECT_GT((x - size * exact).norm(), 1e-9 * size * exact.norm());
  }
  EXPECT_EQ(cholesky.solve(VectorXd::Zero(matrix.rows())), VectorXd::Zero(matrix.rows()));
  cholesky.factor(2 * matrix);
  EXPECT_LT((cholesky.solve(matrix * exact.col(1)) - exact.col(1) / 2).norm(), 1e-12 * exact.norm());
  EXPECT_DOUBLE_EQ(cholesky.factor_megabytes(), whole);
}

TEST(Cholesky, RoughlyOrNotItSaysWhatIsNotDefinite) {
  Cholesky cholesky;
  EXPECT_FALSE(cholesky.factor_roughly(-laplacian(5), 1e-3));
  EXPECT_TRUE(cholesky.factor_roughly(laplacian(5), 1e-3));
  EXPECT_FALSE(cholesky.factor_roughly(-laplacian(5), 1e-3));
}

TEST(Cholesky, IsNotRoundedWhereThatWouldSolveSomethingElse) {
  SparseMatrix matrix = laplacian(8);
  for (int i = 0; i < matrix.rows(); ++i)  // almost singular: a constant is hardly held
    matrix.coeffRef(i, i) = 1e-7 - (matrix.row(i).sum() - matrix.coeff(i, i));
  Cholesky cholesky;
  ASSERT_TRUE(cholesky.factor_roughly(matrix, 1e-2));
  const VectorXd exact = VectorXd::Random(matrix.rows());
  EXPECT_LT((cholesky.solve(matrix * exact) - exact).norm(), 1e-6 * exact.norm());
}

/// What libraries find under the name that GCC calls for a parallel region.
TEST(Cholesky, ParallelRegionsOfLibrariesAreNoTeamsOfThreads) {
  void* found = dlsym(RTLD_DEFAULT, "GOMP_parallel");
  ASSERT_NE(found, nullptr);
  Dl_info where{};
  ASSERT_NE(dladdr(found, &where), 0);
  EXPECT_EQ(std::string(where.dli_fname).find("libgomp"), std::string::npos) << where.dli_fname;
  int calls = 0;
  reinterpret_cast<void (*)(void (*)(void*), void*, unsigned, unsigned)>(found)(
      [](void* data) { ++*static_cast<int*>(data); }, &calls, 4, 0);
  EXPECT_EQ(calls, 1);
}

TEST(Blas, UsesWhatTheProcessorOffers) {
  const bool chosen_by_user = std::getenv("OPENBLAS_CORETYPE") != nullptr;
  prepare_blas();
  EXPECT_NE(blas_kernels(), "");
#ifdef __x86_64__
  const bool has_more = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  EXPECT_TRUE(blas_kernels() != "Prescott" || chosen_by_user || !has_more);
#endif
}

/// Where there is no memory for its buffer OpenBLAS would ask for it without end. In a process of its own, which runs
/// suites of this name before others: one that has the buffer keeps it.
TEST(BlasDeathTest, IsRefusedWhereItsBufferDoesNotFit) {
  if (with_address_sanitizer) GTEST_SKIP() << "the sanitizer takes more address space than can be limited";
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto prepare = [] {
    const LessMemory less(std::size_t{64} << 20);
    try {
      prepare_blas();
    } catch (const RunError& error) {
      std::cerr << error.what();
      std::_Exit(exit_run_failed);  // without what libraries do at the end, which may wait where they get no memory
    }
    std::_Exit(exit_done);
  };
  EXPECT_EXIT(prepare(), testing::ExitedWithCode(exit_run_failed), "no memory is left for a buffer of OpenBLAS");
}

}  // namespace
}  // namespace tether
