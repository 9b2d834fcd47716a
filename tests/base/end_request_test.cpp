#include "common/base/end_request.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "common/base/child_process.hpp"

namespace tether {
namespace {

std::string whether_a_child_sees_it() {
  return capture({{"/bin/sh", "-c", "test -e \"$TETHER_END_REQUEST\" && echo yes || echo no"}, {}}).output;
}

TEST(EndRequests, AreSeenByThisProcessAndThoseItStarts) {
  {
    const EndRequests requests;
    EXPECT_FALSE(end_is_requested());
    EXPECT_EQ(whether_a_child_sees_it(), "no\n");
    raise(SIGUSR1);
    EXPECT_TRUE(end_is_requested());
    EXPECT_EQ(whether_a_child_sees_it(), "yes\n");
  }
  EXPECT_FALSE(end_is_requested()) << "it ends with the front-end";
  unsetenv(end_request_variable);
  EXPECT_FALSE(end_is_requested());
}

/// In a process of its own, which ends by it.
TEST(EndRequests, InterruptWhoDoesNotHeedThem) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto work_on = [] {
    setenv("TETHER_END_LIMIT", "1", 1);
    const EndRequests requests;
    raise(SIGUSR1);
    for (;;) pause();
  };
  EXPECT_EXIT(work_on(), testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace tether
