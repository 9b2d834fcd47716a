#include "common/protocol/stillness.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cstddef>

#include "common/base/limits.hpp"
#include "common/base/process.hpp"

namespace tether::protocol {

void Stillness::look(const Peer& peer) {
  constexpr double longest = 1;  // between two looks, if this process was awake
  const auto now = Clock::now();
  const double passed = std::min(longest, std::chrono::duration<double>(now - last_look_).count());
  last_look_ = now;
  if (peer.pid == 0 || peer.host != host_name()) return;
  const ProcessStatus status = status_of(peer.pid);
  stopped_ = status.is_stopped ? stopped_ + passed : 0;
  idle_ = status.cpu_seconds == cpu_seconds_ ? idle_ + passed : 0;
  cpu_seconds_ = status.cpu_seconds;
}

std::string stopped_text(const Peer& peer) {
  return fmt::format(
      "{} is stopped while {}: kill -CONT {} lets it go on, else the run ends in {:g} s (TETHER_STOPPED_LIMIT=SECONDS "
      "waits longer)",
      peer.describe(), peer.activity, peer.pid, stopped_limit());
}

PeerStopped::PeerStopped(const Peer& peer, double limit)
    : RunError(fmt::format("{} was stopped while {}, and still is {:g} s later (TETHER_STOPPED_LIMIT=SECONDS waits "
                           "longer)",
                           peer.describe(), peer.activity, limit)) {}

/// By a name that only one process of a host can have, for as long as it lives.
bool is_first_to_tell_of(const Peer& peer) {
  const int descriptor = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) return true;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string name = fmt::format("tether-stopped-{}", peer.pid);  // behind a zero: in no folder
  name.copy(address.sun_path + 1, sizeof address.sun_path - 1);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  if (bind(descriptor, reinterpret_cast<const sockaddr*>(&address), size) == 0) return true;
  close(descriptor);
  return false;
}

}  // namespace tether::protocol
