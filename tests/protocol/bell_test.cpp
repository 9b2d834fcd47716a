#include "common/protocol/bell.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <thread>

#include "common/base/process.hpp"

namespace tether::protocol {
namespace {

using namespace std::chrono_literals;

Peer this_process() {
  return {"self", host_name(), getpid()};
}

TEST(Bell, EndsASleepFromAnotherThread) {
  std::thread other([] {
    std::this_thread::sleep_for(20ms);
    EXPECT_TRUE(Bell::own().ring(this_process()));
  });
  EXPECT_TRUE(Bell::own().sleep(1h));
  other.join();
}

TEST(Bell, IsHeardByASleepThatBeginsLaterAndOnce) {
  for (int ring = 0; ring < 3; ++ring) EXPECT_TRUE(Bell::own().ring(this_process()));
  EXPECT_TRUE(Bell::own().sleep(1h));
  EXPECT_FALSE(Bell::own().sleep(1ms));
}

TEST(Bell, ReachesAProcessThatIsRungForMoreOftenThanItLooks) {
  for (int ring = 0; ring < 1000; ++ring) ASSERT_TRUE(Bell::own().ring(this_process()));
  EXPECT_TRUE(Bell::own().sleep(1h));
  EXPECT_FALSE(Bell::own().sleep(1ms));
}

TEST(Bell, KnowsWhomItDoesNotReach) {
  EXPECT_FALSE(Bell::own().ring({"elsewhere", "another_host", getpid()}));
  EXPECT_FALSE(Bell::own().ring({"unknown", host_name(), 0}));
  EXPECT_FALSE(Bell::own().ring({"without a bell", host_name(), getppid()}));
}

}  // namespace
}  // namespace tether::protocol
