#include "common/base/base64.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace tether {
namespace {

/// The table of RFC 4648, section 10.
TEST(Base64, IsThatOfItsTableBothWays) {
  const std::vector<std::pair<std::string, std::string>> known{{"", ""},
                                                               {"f", "Zg=="},
                                                               {"fo", "Zm8="},
                                                               {"foo", "Zm9v"},
                                                               {"foob", "Zm9vYg=="},
                                                               {"fooba", "Zm9vYmE="},
                                                               {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, coded] : known) {
    EXPECT_EQ(base64(plain.data(), plain.size()), coded);
    EXPECT_EQ(from_base64(coded), plain);
  }
}

TEST(Base64, KeepsAllBytes) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes += static_cast<char>(i);
  EXPECT_EQ(from_base64(base64(bytes.data(), bytes.size()) + "\n"), bytes);
}

}  // namespace
}  // namespace tether
