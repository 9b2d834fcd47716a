#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace tether::protocol {

/// A thread that calls `action` every `interval` seconds until this object is gone: what must happen while the process
/// computes, or hangs inside MPI. The argument is the time since the start in seconds.
class Guard {
 public:
  Guard(double interval, std::function<void(double)> action);
  ~Guard();
  Guard(const Guard&) = delete;
  Guard& operator=(const Guard&) = delete;

 private:
  void run(double interval, const std::function<void(double)>& action);

  std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false;
  std::thread thread_;
};

}  // namespace tether::protocol
