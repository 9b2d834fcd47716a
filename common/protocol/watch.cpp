#include "common/protocol/watch.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "common/base/process.hpp"
#include "common/protocol/job.hpp"
#include "common/protocol/signals.hpp"

namespace tether::protocol {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto spin_time = std::chrono::microseconds(100);
constexpr Clock::duration first_nap = std::chrono::microseconds(10);
constexpr auto look_every = std::chrono::milliseconds(200);

/// Doubled up to 0.5 ms; in long waits 1 % of the time waited so far, up to 5 ms.
Clock::duration next_nap(Clock::duration nap, Clock::duration waited) {
  using std::chrono::microseconds;
  return std::max<Clock::duration>(std::min<Clock::duration>(2 * nap, microseconds(500)),
                                   std::min<Clock::duration>(waited / 100, microseconds(5000)));
}

}  // namespace

bool is_dead(const Peer& peer) {
  return peer.pid != 0 && peer.host == host_name() && !is_running(peer.pid);
}

void Watch::release(const Peer& peer) {
  std::erase(peers_, &peer);
  if (master_ == &peer) unfollow();
}

void Watch::abandon(const Peer& peer) {
  if (std::erase(peers_, &peer) > 0) abandoned_.push_back(peer);
}

void Watch::check() const {
  for (const Peer* peer : peers_)
    if (is_dead(*peer)) throw PeerDied(*peer);
}

void Watch::follow(const Peer& master) {
  master_ = &master;
  guard_ = std::make_unique<Guard>(0.2, [master](double) {
    if (is_dead(master)) end_job(exit_run_failed);
  });
}

bool wait_until(const std::function<bool()>& done, const Watch& watch, double limit) {
  const auto start = Clock::now();
  auto look = start + look_every, now = start;
  for (; now - start < spin_time; now = Clock::now()) {
    if (done()) return true;
    std::this_thread::yield();
  }
  for (auto nap = first_nap; !done(); nap = next_nap(nap, now - start)) {
    std::this_thread::sleep_for(nap);
    now = Clock::now();
    if (now >= look || interrupted()) {
      watch.check();
      check_interrupted();
      look = now + look_every;
    }
    if (std::chrono::duration<double>(now - start).count() > limit) return false;
  }
  return true;
}

}  // namespace tether::protocol
