#include "common/protocol/deadline.hpp"

#include <gtest/gtest.h>
#include <pthread.h>

#include <system_error>
#include <thread>

namespace tether::protocol {
namespace {

/// No thread is to be had while this lives: each would want a stack larger than the address space.
class NoMoreThreads {
 public:
  NoMoreThreads() {
    pthread_getattr_default_np(&before_);
    pthread_attr_t greedy;
    pthread_attr_init(&greedy);
    pthread_attr_setstacksize(&greedy, std::size_t{1} << 50);
    pthread_setattr_default_np(&greedy);
    pthread_attr_destroy(&greedy);
  }
  ~NoMoreThreads() {
    pthread_setattr_default_np(&before_);
    pthread_attr_destroy(&before_);
  }
  NoMoreThreads(const NoMoreThreads&) = delete;
  NoMoreThreads& operator=(const NoMoreThreads&) = delete;

 private:
  pthread_attr_t before_;
};

TEST(Deadline, LetsAProcessTakeItsLeaveWhereNoThreadIsToBeHad) {
  const NoMoreThreads none;
  ASSERT_THROW(std::thread([] {}).join(), std::system_error);
  EXPECT_NO_THROW(Deadline(1e3, 1));
}

}  // namespace
}  // namespace tether::protocol
