#include "common/base/process.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>

namespace tether {
namespace {

/// The limit on sizes of files is one of this process: it is set in a child.
class PrepareProcess : public testing::Test {
 protected:
  PrepareProcess() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

/// Ends with the error number of a write beyond the limit on sizes of files, 0 if there is none.
[[noreturn]] void write_beyond_the_limit() {
  prepare_process();
  const rlimit limit{1000, 1000};
  setrlimit(RLIMIT_FSIZE, &limit);
  const int file = memfd_create("file", 0);
  const std::string text(2000, 'x');
  const bool fits = write(file, text.data(), text.size()) == 1000 && write(file, text.data(), 1) == 1;
  _exit(fits ? 0 : errno);
}

TEST_F(PrepareProcess, MakesALimitOnSizesOfFilesAnErrorOfTheWrite) {
  EXPECT_EXIT(write_beyond_the_limit(), testing::ExitedWithCode(EFBIG), "");
}

TEST_F(PrepareProcess, GivesAPathWhereThereIsNone) {
  const auto path_after = [](const char* before) {
    before == nullptr ? unsetenv("PATH") : setenv("PATH", before, 1);
    prepare_process();
    return std::string(std::getenv("PATH"));
  };
  const std::string mine = std::getenv("PATH");
  EXPECT_EQ(path_after("/my/programs"), "/my/programs");
  EXPECT_EQ(path_after(nullptr), "/usr/local/bin:/usr/bin:/bin");
  setenv("PATH", mine.c_str(), 1);
}

}  // namespace
}  // namespace tether
