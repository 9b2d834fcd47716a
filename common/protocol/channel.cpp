#include "common/protocol/channel.hpp"

namespace tether::protocol {

std::string Peer::describe() const {
  return pid == 0 ? role : fmt::format("{} (pid {} on {})", role, pid, host);
}

std::string Peer::failure(const std::string& message) const {
  return fmt::format("{} failed while {}: {}", role, activity, message);
}

PeerDied::PeerDied(const Peer& peer) : RunError(fmt::format("{} died while {}", peer.describe(), peer.activity)) {}

PeerSilent::PeerSilent(const Peer& peer, double limit, const std::string& hint)
    : RunError(fmt::format("{} gave no sign for {} s while {}{}", peer.describe(), limit, peer.activity, hint)) {}

}  // namespace tether::protocol
