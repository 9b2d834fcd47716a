#include "common/protocol/watch.hpp"

#include <sys/prctl.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "common/base/process.hpp"
#include "common/protocol/job.hpp"
#include "common/protocol/signals.hpp"

namespace tether::protocol {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto spin_time = std::chrono::microseconds(30);
constexpr Clock::duration first_nap = std::chrono::microseconds(10);
constexpr auto look_every = std::chrono::milliseconds(200);
constexpr double follow_every = 0.1, follow_after = 0.5;  // seconds

/// An eighth of the time waited so far, up to 0.3 ms; in long waits 4 % of it, up to 5 ms.
Clock::duration nap_after(Clock::duration waited) {
  using std::chrono::microseconds;
  const Clock::duration short_wait = std::min<Clock::duration>(waited / 8, microseconds(300)),
                        long_wait = std::min<Clock::duration>(waited / 25, microseconds(5000));
  return std::max({first_nap, short_wait, long_wait});
}

}  // namespace

bool is_dead(const Peer& peer) {
  return peer.pid != 0 && peer.host == host_name() && !is_running(peer.pid);
}

std::size_t Watch::forget_partner(const Peer& peer) {
  return std::erase_if(partners_, [&](const Partner& partner) { return partner.peer == &peer; });
}

void Watch::release(const Peer& peer) {
  forget_partner(peer);
  if (master_ != &peer) return;
  master_ = nullptr;
  unfollow();
}

void Watch::abandon(const Peer& peer) {
  if (forget_partner(peer) > 0) abandoned_.push_back(peer);
}

void Watch::check_partners() const {
  for (const Partner& partner : partners_) {
    if (!is_dead(*partner.peer)) continue;
    partner.hear();
    throw PeerDied(*partner.peer);
  }
  try {
    check_interrupted();
  } catch (const Interrupted&) {
    for (const Partner& partner : partners_) partner.hear();
    throw;
  }
}

void Watch::follow(const Peer& master) {
  guard_ = std::make_unique<Guard>(follow_every, [master, alive = 0.0](double seconds) mutable {
    if (!is_dead(master)) alive = seconds;
    if (seconds - alive > follow_after) end_job(exit_run_failed);
  });
}

bool wait_until(const std::function<bool()>& done, const std::function<void()>& look, double limit) {
  prctl(PR_SET_TIMERSLACK, 1000UL);  // [ns]: naps last 50 us longer without
  const auto start = Clock::now();
  auto next_look = start + look_every, now = start;
  for (; now - start < spin_time; now = Clock::now()) {
    if (done()) return true;
    std::this_thread::yield();
  }
  while (!done()) {
    std::this_thread::sleep_for(nap_after(now - start));
    now = Clock::now();
    if (now >= next_look || interrupted()) {
      try {
        look();
      } catch (const PeerDied&) {
        if (done()) return true;
        throw;
      }
      next_look = now + look_every;
    }
    if (std::chrono::duration<double>(now - start).count() > limit) return false;
  }
  return true;
}

}  // namespace tether::protocol
