#include "common/protocol/guard.hpp"

#include <chrono>

namespace tether::protocol {

Guard::Guard(double interval, std::function<void(double)> action)
    : thread_([this, interval, action = std::move(action)] { run(interval, action); }) {}

Guard::~Guard() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Guard::run(double interval, const std::function<void(double)>& action) {
  const auto start = std::chrono::steady_clock::now();
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, std::chrono::duration<double>(interval), [this] { return over_; }))
    action(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

}  // namespace tether::protocol
