#include "common/config/followed_points.hpp"

#include <gtest/gtest.h>

#include "tests/config/case_text.hpp"

namespace tether {
namespace {

std::string message_for(const std::string& place) {
  const auto path = write_file("case.yaml", valid_head + "output: {points: {top: " + place + "}}\n");
  Points lumen(3, 2);  // 10 apart
  lumen << 0, 6, 0, 0, 0, 8;
  return input_error_of([&] { check_followed(CaseFile(path), lumen); });
}

TEST(FollowedPoints, AreRefusedBeyondATenthOfTheVessel) {
  EXPECT_EQ(message_for("[0, 0.9, 0]"), "no error");
  EXPECT_EQ(message_for("[6, 1.1, 8]"),
            "case.yaml:6: output.points.top: the nearest node of the lumen is 1.1 away (the vessel's diagonal is 10)");
}

}  // namespace
}  // namespace tether
