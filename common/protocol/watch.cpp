#include "common/protocol/watch.hpp"

#include <sys/prctl.h>
#include <sys/types.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <thread>

#include "common/base/limits.hpp"
#include "common/base/process.hpp"
#include "common/protocol/bell.hpp"
#include "common/protocol/job.hpp"
#include "common/protocol/nodes.hpp"
#include "common/protocol/signals.hpp"
#include "common/protocol/told.hpp"

namespace tether::protocol {

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto spin_time = std::chrono::microseconds(30);
constexpr Clock::duration first_nap = std::chrono::microseconds(10), rung_nap = std::chrono::milliseconds(1);
constexpr auto look_every = std::chrono::milliseconds(200);
constexpr double follow_every = 0.1, follow_after = 0.5, tell_idle_after = 60;  // seconds

/// Beside what a run reports: it goes on.
void say(const std::string& news) {
  fmt::print(stderr, "{}: {}\n", program_invocation_short_name, news);
  std::fflush(stderr);
}

/// An eighth of the time waited so far, up to 0.3 ms; in long waits 4 % of it, up to 5 ms. At least 1 ms if a ring will
/// end it: so much is lost with a ring that comes before its message.
Clock::duration nap_after(Clock::duration waited, bool will_ring) {
  using std::chrono::microseconds;
  const Clock::duration short_wait = std::min<Clock::duration>(waited / 8, microseconds(300)),
                        long_wait = std::min<Clock::duration>(waited / 25, microseconds(5000));
  return std::max({will_ring ? rung_nap : first_nap, short_wait, long_wait});
}

/// Whether it is done within the first moment.
bool comes_at_once(const std::function<bool()>& done) {
  for (const auto start = Clock::now(); Clock::now() - start < spin_time; std::this_thread::yield())
    if (done()) return true;
  return false;
}

/// Says what became of the master, and stays until the others that follow it have seen it too, so that one tells.
void tell_and_stay(const RunError& what) {
  say(what.what());
  note_told(Told::failure);
  std::this_thread::sleep_for(std::chrono::duration<double>(2 * follow_after));
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

void Watch::check_partners() {
  for (Partner& partner : partners_) {
    if (!is_dead(*partner.peer)) {
      check_stopped(partner);
      continue;
    }
    partner.hear();
    throw PeerDied(*partner.peer);
  }
  tell_if_all_are_idle();
  try {
    check_interrupted();
  } catch (const Interrupted&) {
    for (const Partner& partner : partners_) partner.hear();
    throw;
  }
}

void Watch::check_stopped(Partner& partner) {
  partner.stillness.look(*partner.peer);
  const double stopped = partner.stillness.stopped();
  if (stopped > stopped_limit()) throw PeerStopped(*partner.peer, stopped_limit());
  if (stopped == 0) partner.is_told = false;
  if (stopped < tell_stopped_after || partner.is_told) return;
  partner.is_told = true;
  say(stopped_text(*partner.peer));
}

/// A deadlock, a file server that does not answer: nobody can tell it from a code that waits for another machine.
void Watch::tell_if_all_are_idle() {
  std::string who;
  for (const Partner& partner : partners_) {
    if (partner.stillness.idle() < tell_idle_after) {
      is_told_of_idleness_ = false;
      return;
    }
    who += (who.empty() ? "" : ", ") + partner.peer->describe() + " while " + partner.peer->activity;
  }
  if (who.empty() || is_told_of_idleness_) return;
  is_told_of_idleness_ = true;
  say(fmt::format("for {:g} s no processor has been used by {}: stuck, or waiting for something else? This waits on",
                  tell_idle_after, who));
}

void Watch::follow(const Peer& master) {
  guard_ = std::make_unique<Guard>(follow_every, [master, alive = 0.0, still = Stillness()](double seconds) mutable {
    if (!is_dead(master)) alive = seconds;
    if (seconds - alive > follow_after) {
      if (!is_on_first_node() && is_first_to_tell_of(master))  // its own master does not see it
        tell_and_stay(PeerDied(master));
      end_job(exit_run_failed);
    }
    still.look(master);
    if (still.stopped() < stopped_limit()) return;
    const bool is_first = is_first_to_tell_of(master);
    kill(static_cast<pid_t>(master.pid), SIGKILL);  // else it wakes when the job ends, and calls its partners dead
    if (is_first) tell_and_stay(PeerStopped(master, stopped_limit()));
    end_job(exit_run_failed);
  });
}

bool wait_until(const std::function<bool()>& done, const std::function<void()>& look, double limit,
                const std::function<bool()>& will_ring) {
  prctl(PR_SET_TIMERSLACK, 1000UL);  // [ns]: naps last 50 us longer without
  const auto start = Clock::now();
  if (comes_at_once(done)) return true;
  auto now = Clock::now(), next_look = start + look_every;
  while (!done()) {
    if (Bell::own().sleep(nap_after(now - start, will_ring && will_ring())) && comes_at_once(done)) return true;
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
