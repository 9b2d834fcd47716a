#pragma once

#include <sys/types.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace tether {

/// While this lives, a thread looks after a program that runs others (mpirun): processes watch each other, but not when
/// all of them are stopped. That is told on stderr; when it lasts longer than `stopped_limit`, they are killed. So is
/// the program itself where it was told to end, and all that it ran have, but it does not: it writes into a pipe that
/// nobody empties.
class StoppedChildren {
 public:
  /// is_to_end: whether the program was told to end.
  StoppedChildren(pid_t program, std::string name, std::function<bool()> is_to_end);
  ~StoppedChildren();
  StoppedChildren(const StoppedChildren&) = delete;
  StoppedChildren& operator=(const StoppedChildren&) = delete;

  bool were_killed() const { return were_killed_; }

 private:
  void look_now_and_then();

  pid_t program_;
  std::string name_;
  std::function<bool()> is_to_end_;
  std::atomic<bool> were_killed_ = false;
  std::mutex mutex_;
  std::condition_variable ended_;
  bool is_over_ = false;
  std::thread thread_;
};

}  // namespace tether
