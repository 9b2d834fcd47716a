#include "common/config/rules.hpp"

#include <gtest/gtest.h>

namespace tether {
namespace {

TEST(Rules, AreSaidInWords) {
  EXPECT_EQ(rule_of(range::any), "");
  EXPECT_EQ(rule_of(range::positive), "must be positive");
  EXPECT_EQ(rule_of(range::not_negative), "must not be negative");
  EXPECT_EQ(rule_of({1, 8}), "must be at least 1 and at most 8");
  EXPECT_EQ(rule_of({-1, 0.5, true, true}), "must be above -1 and below 0.5");
  EXPECT_EQ(rule_of({-infinite, 3}), "must be at most 3");
}

TEST(Nearest, FindsTheFewestEdits) {
  const std::vector<std::string> known{"density", "viscosity", "damping", "end"};
  EXPECT_EQ(nearest("densty", known), "density");
  EXPECT_EQ(nearest("dnesity", known), "density");
  EXPECT_EQ(nearest("viscosty_", known), "viscosity");
  EXPECT_EQ(nearest("xyz", known), "") << "nothing resembles it";
  EXPECT_EQ(nearest("fax", known), "");
}

}  // namespace
}  // namespace tether
