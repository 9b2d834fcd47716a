#pragma once

#include <chrono>

#include "common/protocol/channel.hpp"

namespace tether::protocol {

/// [s] a person may have meant it.
inline constexpr double tell_stopped_after = 2;

/// For how long another process of this host has been stopped by a signal, or has used no processor, while this one was
/// awake: where both were stopped, as when Slurm suspends a job, it does not count. Of another host's nothing is known.
class Stillness {
 public:
  /// To be called again and again, at least once a second.
  void look(const Peer& peer);
  double stopped() const { return stopped_; }  ///< [s]
  double idle() const { return idle_; }        ///< [s]

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point last_look_ = Clock::now();
  double stopped_ = 0, idle_ = 0, cpu_seconds_ = 0;
};

/// "solid (pid 12 on node) is stopped while computing step 3 (SolidEvaluate); SIGCONT lets it go on, ...".
std::string stopped_text(const Peer& peer);

/// The other process was stopped, and still is after the limit.
struct PeerStopped : RunError {
  PeerStopped(const Peer& peer, double limit);
};

/// Whether this process is the first of this host to say something about that one: of several that wait for it one
/// speaks.
bool is_first_to_tell_of(const Peer& peer);

}  // namespace tether::protocol
