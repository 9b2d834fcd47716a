#include "common/base/shortened.hpp"

#include <gtest/gtest.h>

#include "common/base/name.hpp"

namespace tether {
namespace {

TEST(Shortened, KeepsBeginAndEndOfWhatIsLong) {
  EXPECT_EQ(shortened(""), "");
  EXPECT_EQ(shortened(std::string(60, 'a')), std::string(60, 'a'));
  EXPECT_EQ(shortened("k*" + std::string(60'000, '-') + "un"),
            "k*" + std::string(28, '-') + " ... " + std::string(28, '-') + "un");
  EXPECT_EQ(shortened("0123456789", 4), "01 ... 89");
}

TEST(Shortened, KeepsCharactersWhole) {
  std::string text = "a";
  for (int i = 0; i < 100; ++i) text += "\u20ac";
  for (std::size_t most = 2; most < 20; ++most) EXPECT_TRUE(is_utf8(shortened(text, most))) << most;
}

}  // namespace
}  // namespace tether
