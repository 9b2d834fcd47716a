#include "identification_master/group_memory.hpp"

#include <gtest/gtest.h>

namespace tether {
namespace {

TEST(GroupMemory, IsNotBelowWhatWasMeasured) {
  EXPECT_GT(memory_of_group(2037 + 1008), 108e6);
  EXPECT_GT(memory_of_group(22734 + 19440), 733e6);
  EXPECT_LT(memory_of_group(22734 + 19440), 1.5 * 733e6);
}

TEST(GroupMemory, LimitsGroupsButLeavesOne) {
  EXPECT_EQ(groups_within(24e9, 42174), 20U);
  EXPECT_EQ(groups_within(2e9, 42174), 1U);
  EXPECT_EQ(groups_within(1e6, 42174), 1U);
  EXPECT_GT(groups_within(available_memory(), 1), 0U);
}

}  // namespace
}  // namespace tether
