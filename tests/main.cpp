#include <gtest/gtest.h>

#include <cstdio>
#include <string_view>
#include <vector>

/// The tests of a folder: those that stand in the source files named on the command line, or all of them.
namespace {

/// The filter that chooses the tests of a source file; "" if it has none.
std::string tests_in(const std::string& source) {
  std::string filter;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    const std::string begin = std::string(suite.name()) + ".";
    std::vector<std::string> tests;
    for (int k = 0; k < suite.total_test_count(); ++k)
      if (const testing::TestInfo& test = *suite.GetTestInfo(k); std::string_view(test.file()).ends_with("/" + source))
        tests.push_back(begin + test.name() + ":");
    if (static_cast<int>(tests.size()) == suite.total_test_count()) tests.assign(1, begin + "*:");
    for (const std::string& test : tests) filter += test;
  }
  return filter;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  std::string filter;
  for (int i = 1; i < argc; ++i) {
    const std::string tests = tests_in(argv[i]);
    if (tests.empty()) return std::fprintf(stderr, "%s has no tests\n", argv[i]), 1;
    filter += tests;
  }
  if (!filter.empty()) testing::GTEST_FLAG(filter) = filter;
  return RUN_ALL_TESTS();
}
