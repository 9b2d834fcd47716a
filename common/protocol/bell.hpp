#pragma once

#include <chrono>

#include "common/protocol/channel.hpp"

namespace tether::protocol {

/// What wakes a process of this host that waits for a message: MPI itself can only be asked again and again. A ring
/// says nothing but "look": one too many costs a look, one that is lost costs a nap.
class Bell {
 public:
  /// This process's.
  static Bell& own();
  /// Wakes the peer. Returns whether it has a bell that can be reached from here; then it rings too.
  bool ring(const Peer& peer) const;
  /// Sleeps until somebody has rung since the last time, at most so long. Returns whether somebody has.
  bool sleep(std::chrono::nanoseconds at_most);

  Bell(const Bell&) = delete;
  Bell& operator=(const Bell&) = delete;

 private:
  Bell();
  ~Bell();

  int descriptor_ = -1;
};

}  // namespace tether::protocol
