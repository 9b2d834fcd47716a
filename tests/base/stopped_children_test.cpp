#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "common/base/child_process.hpp"

namespace tether {
namespace {

/// A program that stops all that it started, and waits for it, is told of and does not wait for ever.
TEST(StoppedChildren, AreToldAndEndedAfterAWhile) {
  setenv("TETHER_STOPPED_LIMIT", "1", 1);
  ::testing::internal::CaptureStderr();
  const ForegroundEnd end =
      run_in_foreground({{"/bin/sh", "-c", "sleep 60 & a=$!; sleep 60 & b=$!; kill -STOP $a $b; wait $a; exit 7"}, {}});
  const std::string told = ::testing::internal::GetCapturedStderr();
  unsetenv("TETHER_STOPPED_LIMIT");
  EXPECT_EQ(end.exit_code, 7);
  EXPECT_TRUE(end.was_still);
  EXPECT_NE(told.find("are stopped: kill -CONT "), std::string::npos) << told;
  EXPECT_NE(told.find("were stopped, and still are 1 s later"), std::string::npos) << told;
}

TEST(StoppedChildren, OfWhichOneGoesOnAreLeftAlone) {
  setenv("TETHER_STOPPED_LIMIT", "1", 1);
  ::testing::internal::CaptureStderr();
  const ForegroundEnd end =
      run_in_foreground({{"/bin/sh", "-c", "sleep 60 & a=$!; kill -STOP $a; sleep 5; kill -KILL $a"}, {}});
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  unsetenv("TETHER_STOPPED_LIMIT");
  EXPECT_FALSE(end.was_still);
}

/// As an mpirun does whose programs have ended and that writes into a pipe which nobody empties.
TEST(StoppedChildren, AProgramThatWasToldToEndIsKilledWhenItHasNoneLeft) {
  const auto begin = std::chrono::steady_clock::now();
  const ForegroundEnd end = run_in_foreground({{"/bin/sh", "-c", "trap '' TERM; kill -TERM $PPID; exec sleep 60"}, {}});
  EXPECT_EQ(end.exit_code, 128 + SIGKILL);
  EXPECT_EQ(end.handed_on, SIGTERM);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

TEST(StoppedChildren, AProgramThatWasNotToldToEndMayStandAlone) {
  EXPECT_EQ(run_in_foreground({{"/bin/sh", "-c", "exec sleep 5"}, {}}).exit_code, 0);
}

}  // namespace
}  // namespace tether
