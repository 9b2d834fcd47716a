#include "common/base/interruption.hpp"

#include <gtest/gtest.h>

#include <csignal>

#include "common/base/error.hpp"

namespace tether {
namespace {

void is_interrupted_by(int signal) {
  end_when_interrupted();
  const WhenInterrupted way_on("the same command goes on from here");
  std::raise(signal);
}

TEST(InterruptionDeathTest, IsToldWithTheWayOn) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    EXPECT_EXIT(is_interrupted_by(signal), ::testing::ExitedWithCode(exit_run_failed),
                "^tether: interrupted; the same command goes on from here\n$")
        << signal;
}

/// As nohup wants it.
TEST(InterruptionDeathTest, AClosedTerminalIsNoneWhereThatIsIgnored) {
  const auto is_ignored = [] {
    std::signal(SIGHUP, SIG_IGN);
    is_interrupted_by(SIGHUP);
    std::_Exit(7);
  };
  EXPECT_EXIT(is_ignored(), ::testing::ExitedWithCode(7), "^$");
}

}  // namespace
}  // namespace tether
