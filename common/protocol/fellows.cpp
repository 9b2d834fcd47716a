#include "common/protocol/fellows.hpp"

#include <array>
#include <cstdint>
#include <utility>

#include "common/base/limits.hpp"
#include "common/base/process.hpp"
#include "common/protocol/guard.hpp"
#include "common/protocol/job.hpp"
#include "common/protocol/last_words.hpp"
#include "common/protocol/signals.hpp"
#include "common/protocol/spawn.hpp"
#include "common/protocol/stillness.hpp"
#include "common/protocol/watch.hpp"

namespace tether::protocol {
namespace {

/// [s] between looks whether the others live.
constexpr double look_after_every = 0.1;

std::vector<Peer> introduce(const std::string& role, MPI_Comm communicator) {
  struct Name {
    std::array<char, 120> host{};
    std::int64_t pid = process_id();
  } mine;
  host_name().copy(mine.host.data(), mine.host.size() - 1);
  std::vector<Name> all(static_cast<std::size_t>(size_of(communicator)));
  check_mpi(MPI_Allgather(&mine, sizeof mine, MPI_BYTE, all.data(), sizeof mine, MPI_BYTE, communicator),
            "MPI_Allgather");
  std::vector<Peer> peers;
  for (const Name& name : all)
    peers.push_back({fmt::format("process {} of {} of {}", peers.size() + 1, all.size(), role), name.host.data(),
                     name.pid, "working with the others"});
  return peers;
}

std::string died(const Peer& peer) {
  const std::string words = last_words_of(peer);
  return words.empty() ? peer.describe() + " died" : peer.failure(words);
}

}  // namespace

Fellows::Fellows(std::string role, int communicator)
    : role_(std::move(role)), peers_(introduce(role_, MPI_Comm_f2c(communicator))) {
  if (rank_in(MPI_Comm_f2c(communicator)) == 0)
    look_after_others();
  else
    delay_termination();
}

Fellows::~Fellows() = default;

void Fellows::look_after_others() {
  guard_ = std::make_unique<Guard>(
      look_after_every, [this, still = std::vector<Stillness>(peers_.size()), is_told = false](double) mutable {
        for (std::size_t rank = 1; rank < peers_.size(); ++rank) {
          const Peer& peer = peers_[rank];
          if (is_dead(peer)) end_because(died(peer));
          still[rank].look(peer);
          if (still[rank].stopped() > stopped_limit()) end_because(PeerStopped(peer, stopped_limit()).what());
          if (still[rank].stopped() > tell_stopped_after && !std::exchange(is_told, true))
            fmt::print(stderr, "{}: {}\n", role_, stopped_text(peer));
        }
      });
}

void Fellows::end_because(const std::string& why) const {
  leave_last_words(why);
  end_job(exit_run_failed, {peers_.begin() + 1, peers_.end()});
}

void Fellows::part() {
  guard_.reset();
}

}  // namespace tether::protocol
