// BiCGStab for three right-hand sides against a direct solve.
#include "fluid/bicgstab.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "tests/linalg/thread_team.hpp"

namespace tether {
namespace {

/// Advection and diffusion on a line of n cells: not symmetric.
SparseMatrix advection_diffusion(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2.5);
    if (i > 0) entries.emplace_back(i, i - 1, -1.9);
    if (i + 1 < n) entries.emplace_back(i, i + 1, -0.4);
    if (i >= 10) entries.emplace_back(i, i - 10, -0.15);  // ILU(0) is then not exact
  }
  SparseMatrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Points random(int n) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Points result(3, n);
  for (double& x : result.reshaped()) x = uniform(generator);
  return result;
}

struct Problem {
  SparseMatrix matrix = advection_diffusion(200);
  Points rhs = random(200);
  Ilu0 preconditioner;
  Problem() { preconditioner.factor(matrix); }
  Points exact() const {
    const Eigen::MatrixXd dense = matrix;
    return dense.partialPivLu().solve(rhs.transpose().eval()).transpose();
  }
};

TEST(Bicgstab, AgreesWithADirectSolve) {
  const Problem p;
  Points x = Points::Zero(3, 200);
  const KrylovResult result = bicgstab(p.matrix, p.preconditioner, p.rhs, x, 1e-12, 100);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(result.residual, 2e-12);
  EXPECT_LT((x - p.exact()).norm(), 1e-10 * x.norm());
}

TEST(Bicgstab, StopsAtOnceFromTheSolutionAndForZero) {
  const Problem p;
  Points x = p.exact();
  EXPECT_EQ(bicgstab(p.matrix, p.preconditioner, p.rhs, x, 1e-10, 100).iterations, 0);
  Points zero = Points::Zero(3, 200);
  const KrylovResult result = bicgstab(p.matrix, p.preconditioner, Points::Zero(3, 200), zero, 1e-10, 100);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(zero.norm(), 0);
}

TEST(Bicgstab, ServesRightHandSidesOfDifferentSizesAndZeroOnes) {
  Problem p;
  p.rhs.row(0) *= 1e6;
  p.rhs.row(1).setZero();
  Points x = Points::Zero(3, 200);
  EXPECT_TRUE(bicgstab(p.matrix, p.preconditioner, p.rhs, x, 1e-13, 100).converged);
  EXPECT_LT((x - p.exact()).norm(), 1e-10 * x.norm());
  EXPECT_EQ(x.row(1).norm(), 0);
}

TEST(Bicgstab, SaysWhenItDoesNotConverge) {
  const Problem p;
  Points x = Points::Zero(3, 200);
  const KrylovResult result = bicgstab(p.matrix, p.preconditioner, p.rhs, x, 1e-14, 1);
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.iterations, 1);
  EXPECT_GT(result.residual, 1e-14);
}

TEST(Bicgstab, SharedByProcessesItSolvesTheSame) {
  const Problem p;
  // The rows of three processes; the pattern must be symmetric.
  const SparseMatrix transposed = p.matrix.transpose();
  const SparseMatrix matrix = p.matrix + 0 * transposed;
  std::vector<int> owner(200);
  for (int node = 0; node < 200; ++node) owner[static_cast<std::size_t>(node)] = node / 70;
  const Points exact = p.exact();
  in_team(3, [&](Team& team) {
    const Share share(team, owner);
    OwnRows rows(share, matrix);
    rows.take(matrix);
    Ilu0 preconditioner;
    preconditioner.factor(rows.block());
    Points x = Points::Zero(3, rows.all());
    const KrylovResult result = bicgstab(rows, preconditioner, rows.own_of(p.rhs), x, 1e-12, 100);
    EXPECT_TRUE(result.converged);
    EXPECT_LT(result.residual, 2e-12);
    Points all = Points::Zero(3, 200);
    rows.put_back(x, all);
    share.complete(all);
    EXPECT_LT((all - exact).norm(), 1e-10 * exact.norm());
  });
}

}  // namespace
}  // namespace tether
