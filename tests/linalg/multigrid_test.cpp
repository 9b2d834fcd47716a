// Multigrid of several processes against a direct solve.
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "tests/io/mpirun.hpp"

namespace tether {
namespace multigrid_test {

class Multigrid : public ::testing::TestWithParam<int> {};

TEST_P(Multigrid, SolvesAsAFactorDoes) {
  const ChildEnd end =
      capture(on_mpirun({"-n", std::to_string(GetParam()), MULTIGRID_PROGRAM}, {{"LD_LIBRARY_PATH", PROGRAMS_FOLDER}}));
  ASSERT_EQ(end.exit_code, 0) << end.errors;
  std::istringstream told(end.output);
  std::vector<double> errors;
  for (double error = 0; told >> error;) errors.push_back(error);
  ASSERT_EQ(errors.size(), 5U) << end.output << end.errors;
  for (const double error : errors) EXPECT_LT(error, 1e-8) << end.output;
  EXPECT_GT(errors[3], 0.0) << "a hierarchy of an earlier matrix gives other last bits";
  EXPECT_EQ(errors[4], 0.0) << "one that is forgotten does not";
}

INSTANTIATE_TEST_SUITE_P(Processes, Multigrid, ::testing::Values(2, 3));

}  // namespace multigrid_test
}  // namespace tether
