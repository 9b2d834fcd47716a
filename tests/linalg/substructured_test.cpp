// A direct solve shared by several processes against that of one.
#include "common/linalg/substructured.hpp"

#include <gtest/gtest.h>

#include "common/linalg/cholesky.hpp"
#include "tests/linalg/block_of_springs.hpp"
#include "tests/linalg/thread_team.hpp"

namespace tether {
namespace substructured_test {

using namespace block_of_springs;

struct Shared {
  Shared(Team& team, int n, int components, double hold)
      : nodes(2 * n * n * n), share(team, owners(n, team.size())), solver(share) {
    matrix = assembled_here(share, n, components, hold);
    solver.analyze(matrix, components);
  }
  int nodes;
  Share share;
  SparseMatrix matrix;
  SubstructuredSolver solver;
};

class Substructured : public ::testing::TestWithParam<std::tuple<int, int>> {};

/// hold = 0.01: a part on its own is all but loose.
TEST_P(Substructured, SolvesAsOneProcessDoes) {
  const int processes = std::get<0>(GetParam()), components = std::get<1>(GetParam());
  constexpr int n = 6;
  for (const double hold : {1.0, 0.01}) {
    const SparseMatrix whole = assembled(2 * n * n * n, components, cubes(n), hold);
    Cholesky alone;
    alone.analyze(whole, components);
    alone.factor(whole);
    Eigen::MatrixXd rhs(whole.rows(), 2);
    rhs << some_load(whole.rows()), some_load(whole.rows()).cwiseAbs();
    Eigen::MatrixXd expected = rhs;
    alone.solve_in_place(expected);
    in_team(processes, [&](Team& team) {
      Shared shared(team, n, components, hold);
      ASSERT_TRUE(shared.solver.factor_if_definite(shared.matrix));
      EXPECT_GT(shared.solver.between(), 0);
      EXPECT_LT(shared.solver.between(), whole.rows() / 2);
      Eigen::MatrixXd mine = Eigen::MatrixXd::Constant(rhs.rows(), 2, 1e9);  // of others' nodes it is not read
      for (const int node : shared.share.own())
        mine.middleRows(node * components, components) = rhs.middleRows(node * components, components);
      shared.solver.solve_in_place(mine);
      EXPECT_LT((mine - expected).norm(), 1e-11 * expected.norm()) << hold;
    });
  }
}

TEST_P(Substructured, RoundedToSingleItSolvesAlmostAsWellInLessMemory) {
  const int processes = std::get<0>(GetParam()), components = std::get<1>(GetParam());
  constexpr int n = 6;
  in_team(processes, [&](Team& team) {
    Shared shared(team, n, components, 1.0);
    ASSERT_TRUE(shared.solver.factor_if_definite(shared.matrix));
    const VectorXd rhs = some_load(shared.matrix.rows()), exact = shared.solver.solve(rhs);
    const double whole = shared.solver.factor_megabytes();
    ASSERT_TRUE(shared.solver.factor_roughly(shared.matrix, 1e-4));
    EXPECT_LT(shared.solver.factor_megabytes(), whole);
    const VectorXd rough = shared.solver.solve(rhs);
    EXPECT_LT((rough - exact).norm(), 1e-5 * exact.norm());
    EXPECT_NE(rough, exact);
    ASSERT_TRUE(shared.solver.factor_roughly(shared.matrix, 1e-14));  // too rough for this: it stays exact
    EXPECT_LT((shared.solver.solve(rhs) - exact).norm(), 1e-13 * exact.norm());
  });
}

INSTANTIATE_TEST_SUITE_P(Parts, Substructured, ::testing::Combine(::testing::Values(2, 3, 5), ::testing::Values(1, 3)));

TEST(SubstructuredSolver, AllSeeThatAMatrixIsNotDefinite) {
  in_team(3, [](Team& team) {
    Shared shared(team, 5, 1, 1.0);
    ASSERT_TRUE(shared.solver.factor_if_definite(shared.matrix));
    for (const int bad : {0, 124, 249}) {  // of one process each, or between them
      SparseMatrix matrix = shared.matrix;
      if (shared.share.is_own(bad)) matrix.coeffRef(bad, bad) = -50;
      EXPECT_FALSE(shared.solver.factor_if_definite(matrix)) << bad;
      EXPECT_FALSE(shared.solver.has_factor());
    }
    EXPECT_TRUE(shared.solver.factor_if_definite(shared.matrix));
  });
}

TEST(SubstructuredSolver, GivesTheSameBitsAgain) {
  std::vector<VectorXd> all(2);
  for (VectorXd& result : all)
    in_team(4, [&result](Team& team) {
      Shared shared(team, 6, 3, 1.0);
      ASSERT_TRUE(shared.solver.factor_if_definite(shared.matrix));
      const VectorXd x = shared.solver.solve(some_load(shared.matrix.rows()));
      if (team.rank() == 3) result = x;
    });
  EXPECT_EQ(all[0], all[1]);
}

}  // namespace substructured_test
}  // namespace tether
