#include "common/base/circumstances.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>

#include "common/base/error.hpp"
#include "common/base/limits.hpp"

namespace tether {
namespace {

constexpr double no_space = 0;

std::string refusal(double free_mb = no_space) {
  try {
    check_circumstances(free_mb);
  } catch (const RunError& error) {
    return error.what();
  }
  return "";
}

/// The same under a limit.
std::string refusal_under(__rlimit_resource of, rlim_t least) {
  rlimit before{};
  getrlimit(of, &before);
  const rlimit limit{least, before.rlim_max};
  setrlimit(of, &limit);
  std::string told = refusal();
  setrlimit(of, &before);
  return told;
}

TEST(Circumstances, TellWhichLimitLeavesTooLittle) {
  EXPECT_EQ(refusal(), "");
  EXPECT_EQ(refusal_under(RLIMIT_NOFILE, 39), "only 39 files may be open at once (ulimit -n): at least 40 are needed");
  EXPECT_EQ(refusal_under(RLIMIT_NOFILE, 40), "");
  EXPECT_EQ(refusal_under(RLIMIT_FSIZE, 1'000'000), "only 1 MB may be in a file (ulimit -f): at least 4.19 are needed");
  EXPECT_EQ(refusal_under(RLIMIT_STACK, 64 << 10),
            "only 64 kB may be taken by a program's stack (ulimit -s): at least 512 are needed");
}

TEST(Circumstances, TellThatTheDiskOfTmpdirIsTooFull) {
  const std::string told = refusal(1e12);
  EXPECT_NE(told.find(" MB are left on its disk, of which a run needs 1000000000000: TMPDIR=FOLDER takes another one"),
            std::string::npos)
      << told;
}

TEST(Circumstances, TellOfALimitThatIsNoNumber) {
  for (const char* wrong : {"abc", "-1", "0", "5 min", "nan"}) {
    setenv("TETHER_STOPPED_LIMIT", wrong, 1);
    std::string told;
    try {
      check_limits();
    } catch (const InputError& error) {
      told = error.what();
    }
    EXPECT_EQ(told, fmt::format("TETHER_STOPPED_LIMIT: '{}' is not a number of seconds above zero", wrong));
    EXPECT_EQ(stopped_limit(), 60);
  }
  setenv("TETHER_STOPPED_LIMIT", "2.5", 1);
  EXPECT_NO_THROW(check_limits());
  EXPECT_EQ(stopped_limit(), 2.5);
  unsetenv("TETHER_STOPPED_LIMIT");
  EXPECT_NO_THROW(check_limits());
}

}  // namespace
}  // namespace tether
