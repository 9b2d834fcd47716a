#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "common/base/effect.hpp"
#include "common/protocol/channel.hpp"
#include "common/protocol/guard.hpp"

namespace tether::protocol {

/// The peers of this process: those without which this one cannot go on: the master's partners, or a partner's master.
/// MPI does not report a death (docs/decisions/0002), so the process table is asked.
class Watch {
 public:
  void add(const Peer& peer) { peers_.push_back(&peer); }
  /// The peer ended in good order.
  void release(const Peer& peer);
  /// The peer is dead, busy or silent, and nobody talks to it any more.
  void abandon(const Peer& peer);
  /// Throws PeerDied for the first peer on this host that does not run any more.
  void check() const;
  /// From now on this process ends with its master, even in the middle of a computation; until released.
  void follow(const Peer& master);
  void unfollow() { guard_.reset(); }

  bool all_released() const { return peers_.empty() && abandoned_.empty(); }
  const std::vector<Peer>& abandoned() const { return abandoned_; }

 private:
  std::vector<const Peer*> peers_;
  std::vector<Peer> abandoned_;
  const Peer* master_ = nullptr;
  std::unique_ptr<Guard> guard_;
};

/// Whether the peer is known to be gone: its pid does not run on this host. What other hosts do is mpirun's to notice.
bool is_dead(const Peer& peer);

/// Waits until `done` without burning a core: tries for 0.1 ms, then naps of 10 us, doubling up to 0.5 ms, in long
/// waits 1 % of the time waited (at most 5 ms). Looks after `watch` every 0.2 s. False if `limit` seconds passed.
/// Throws PeerDied, Interrupted.
bool wait_until(const std::function<bool()>& done, const Watch& watch, double limit = infinite);

}  // namespace tether::protocol
