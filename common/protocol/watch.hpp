#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "common/base/effect.hpp"
#include "common/protocol/channel.hpp"
#include "common/protocol/guard.hpp"
#include "common/protocol/stillness.hpp"

namespace tether::protocol {

/// The peers without which this process cannot go on: its partners if it is a master, its master if it is a partner, or
/// both. MPI does not report a death (docs/decisions/0002), so the process table is asked.
class Watch {
 public:
  /// Throws RunError if the partner has sent a Failure that nobody has read.
  using Hear = std::function<void()>;

  void add_partner(const Peer& peer, Hear hear) { partners_.push_back({&peer, std::move(hear)}); }
  void add_master(const Peer& peer) { master_ = &peer; }
  /// The peer ended in good order.
  void release(const Peer& peer);
  /// The peer is dead, busy or silent, and nobody talks to it any more.
  void abandon(const Peer& peer);

  /// Throws PeerDied for the first partner on this host that does not run any more, or Interrupted; or, instead, what
  /// the partner that died (after a signal: any partner) has said before: it tells more. Tells that one is stopped, and
  /// throws PeerStopped if it remains so; tells that none uses its processor any more.
  void check_partners();
  /// From now on this process ends half a second after its master, even in the middle of a computation; until released.
  /// No sooner: between SIGTERM and SIGKILL mpirun waits a second, but only until any process ends, and in that second
  /// somebody may have to say what happened.
  void follow(const Peer& master);
  void unfollow() { guard_.reset(); }

  bool all_released() const { return partners_.empty() && abandoned_.empty() && master_ == nullptr; }
  const std::vector<Peer>& abandoned_partners() const { return abandoned_; }

 private:
  struct Partner {
    const Peer* peer;
    Hear hear;
    Stillness stillness = {};
    bool is_told = false;  ///< that it is stopped
  };
  void check_stopped(Partner& partner);
  void tell_if_all_are_idle();
  std::size_t forget_partner(const Peer& peer);

  std::vector<Partner> partners_;
  std::vector<Peer> abandoned_;
  const Peer* master_ = nullptr;
  std::unique_ptr<Guard> guard_;
  bool is_told_of_idleness_ = false;
};

/// Whether the peer is known to be gone: its pid does not run on this host. What other hosts do is mpirun's to notice.
bool is_dead(const Peer& peer);

/// Waits until `done` without burning a core: tries for 0.03 ms, then naps (watch.cpp says how long), which a ring of
/// the bell ends. While `will_ring`, naps are long: what is waited for comes with a ring. Calls `look` every 0.2 s, and
/// all the time after a signal; what it throws ends the wait, but not PeerDied if `done` comes true after all. False if
/// `limit` seconds passed.
bool wait_until(const std::function<bool()>& done, const std::function<void()>& look, double limit = infinite,
                const std::function<bool()>& will_ring = {});

}  // namespace tether::protocol
