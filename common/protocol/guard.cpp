#include "common/protocol/guard.hpp"

#include <chrono>

namespace tether::protocol {

Guard::Guard(double interval, std::function<void()> action)
    : thread_([this, interval, action = std::move(action)] {
        std::unique_lock lock(mutex_);
        while (!changed_.wait_for(lock, std::chrono::duration<double>(interval), [this] { return over_; })) action();
      }) {}

Guard::~Guard() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

}  // namespace tether::protocol
