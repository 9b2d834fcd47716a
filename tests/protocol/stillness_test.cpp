#include "common/protocol/stillness.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "common/base/process.hpp"

namespace tether::protocol {
namespace {

/// A child that does nothing, or nothing but compute; it ends with this object.
class Child {
 public:
  explicit Child(bool computes) : pid_(fork()) {
    if (pid_ != 0) return;
    for (volatile bool waits = !computes; true;)
      if (waits) pause();
  }
  ~Child() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void send(int signal) const { kill(pid_, signal); }
  Peer peer() const { return {"solid", host_name(), pid_}; }

 private:
  pid_t pid_;
};

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

void look_for(double seconds, Stillness& still, const Peer& peer) {
  const auto begin = Clock::now();
  while (seconds_since(begin) < seconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    still.look(peer);
  }
}

TEST(Stillness, SeesThatAProcessIsStoppedAndGoesOn) {
  const Child child(false);
  const auto begin = Clock::now();
  Stillness still;
  look_for(0.2, still, child.peer());
  EXPECT_EQ(still.stopped(), 0);
  child.send(SIGSTOP);
  look_for(0.6, still, child.peer());
  EXPECT_GT(still.stopped(), 0.3);
  EXPECT_LE(still.stopped(), seconds_since(begin));
  child.send(SIGCONT);
  look_for(0.2, still, child.peer());
  EXPECT_EQ(still.stopped(), 0);
}

/// Ticks of the processor come every hundredth of a second: on however busy a machine, a few in five seconds.
TEST(Stillness, TellsAnIdleProcessFromOneThatComputes) {
  const Child waits(false), computes(true);
  Stillness of_waiting, of_computing;
  look_for(0.6, of_waiting, waits.peer());
  EXPECT_GT(of_waiting.idle(), 0.3);
  double longest = 0;
  for (int i = 0; i < 10; ++i) {
    look_for(0.5, of_computing, computes.peer());
    longest = std::max(longest, of_computing.idle());
  }
  EXPECT_LT(longest, 4);
}

/// Time in which this process did not look does not count, but for a second: it may have been stopped as well.
TEST(Stillness, CountsNoTimeInWhichItWasNotAwakeItself) {
  const Child child(false);
  child.send(SIGSTOP);
  const auto begin = Clock::now();
  Stillness still;
  look_for(0.1, still, child.peer());
  const double looked = seconds_since(begin);
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));
  still.look(child.peer());
  EXPECT_GT(still.stopped(), 0.5);
  EXPECT_LE(still.stopped(), looked + 1);
}

TEST(Stillness, KnowsNothingOfOtherHosts) {
  const Child child(false);
  child.send(SIGSTOP);
  Peer elsewhere = child.peer();
  elsewhere.host += "x";
  Stillness still;
  look_for(0.3, still, elsewhere);
  EXPECT_EQ(still.stopped(), 0);
  EXPECT_EQ(still.idle(), 0);
}

}  // namespace
}  // namespace tether::protocol
