#include "common/protocol/roster.hpp"

#include <gtest/gtest.h>

#include "common/base/error.hpp"

namespace tether::protocol {
namespace {

using Roles = std::vector<std::string>;

TEST(Roster, One_group_in_any_order) {
  const Roles roles{"solid", "fsi_master", "fluid"};
  EXPECT_EQ(master_of(roles, 0), 1);
  EXPECT_EQ(master_of(roles, 1), -1);
  EXPECT_EQ(partners_of(roles, 1), (std::vector{0, 2}));
}

TEST(Roster, Several_groups_listed_by_group_or_by_role) {
  const Roles by_group{"identification_master", "fsi_master", "fluid", "solid", "fsi_master", "fluid", "solid"};
  EXPECT_EQ(partners_of(by_group, 0), (std::vector{1, 4}));
  EXPECT_EQ(partners_of(by_group, 4), (std::vector{5, 6}));
  const Roles by_role{"identification_master", "fsi_master", "fsi_master", "fluid", "fluid", "solid", "solid"};
  EXPECT_EQ(partners_of(by_role, 2), (std::vector{4, 6}));
  EXPECT_EQ(master_of(by_role, 1), 0);
}

TEST(Roster, Further_ranks_of_a_parallel_code_are_nobody) {
  const Roles roles{"fsi_master", "fluid", "", "", "solid"};
  EXPECT_EQ(partners_of(roles, 0), (std::vector{1, 4}));
  EXPECT_EQ(master_of(roles, 2), -1);
}

TEST(Roster, Uneven_groups_are_refused) {
  const Roles roles{"fsi_master", "fsi_master", "fluid", "solid", "solid"};
  EXPECT_THROW(partners_of(roles, 0), InputError);
}

TEST(Roster, One_leads) {
  for (const Roles& led :
       {Roles{"fsi_master", "fluid", "fluid", "solid"}, Roles{"fluid", "", "my_master"},
        Roles{"fsi_master", "identification_master", "fsi_master"}, Roles{"fluid", "fluid"}, Roles{}})
    EXPECT_NO_THROW(check_one_leads(led));
  EXPECT_THROW(check_one_leads({"fsi_master", "fsi_master"}), InputError);
  EXPECT_THROW(check_one_leads({"identification_master", "fsi_master", "fsi_master", "identification_master"}),
               InputError);
  try {
    check_one_leads({"fsi_master", "fluid", "my_master", "fsi_master"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "the mpirun line has 3 masters that none leads (fsi_master, my_master), each of which would make a "
                 "run: give it one");
  }
}

}  // namespace
}  // namespace tether::protocol
