#pragma once

#include <csignal>

namespace tether {

/// From now on Ctrl-C (SIGINT) and SIGTERM end this program with exit code 1 and say so, where no program that it runs
/// takes them.
void end_when_interrupted();

/// While this lives, the way on that is told then; within another, that of the other.
class WhenInterrupted {
 public:
  /// way_on: text that lives as long as the program.
  explicit WhenInterrupted(const char* way_on);
  ~WhenInterrupted();
  WhenInterrupted(const WhenInterrupted&) = delete;
  WhenInterrupted& operator=(const WhenInterrupted&) = delete;
  /// Whether one lives.
  static bool is_told();

 private:
  bool tells_;
};

/// While this lives, SIGINT, SIGTERM and SIGHUP wait: what must not be broken off is brought to its end. Then the one
/// that came does what it does. A program that is to be let alone, too, is one of capture_in_foreground.
class InterruptionsWait {
 public:
  InterruptionsWait();
  ~InterruptionsWait();
  InterruptionsWait(const InterruptionsWait&) = delete;
  InterruptionsWait& operator=(const InterruptionsWait&) = delete;

 private:
  sigset_t before_{};
};

}  // namespace tether
