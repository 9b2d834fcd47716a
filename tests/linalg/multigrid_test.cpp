// Multigrid of several processes against a direct solve.
#include <gtest/gtest.h>

#include <sstream>

#include "tests/io/mpirun.hpp"

namespace tether {
namespace multigrid_test {

class Multigrid : public ::testing::TestWithParam<int> {};

TEST_P(Multigrid, SolvesAsAFactorDoes) {
  const ChildEnd end = capture(on_mpirun({"-n", std::to_string(GetParam()), MULTIGRID_PROGRAM}));
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  std::istringstream told(end.output);
  int solved = 0;
  for (double error = 0; told >> error; ++solved) EXPECT_LT(error, 1e-8) << solved;
  EXPECT_EQ(solved, 3) << end.output << end.errors;
}

INSTANTIATE_TEST_SUITE_P(Processes, Multigrid, ::testing::Values(2, 3));

}  // namespace multigrid_test
}  // namespace tether
