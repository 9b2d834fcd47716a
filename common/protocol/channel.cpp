#include "common/protocol/channel.hpp"

#include "common/protocol/last_words.hpp"

namespace tether::protocol {

namespace {

/// By what users see of it: both roles of observations are played by one program.
std::string program_of(const std::string& role) {
  return role.ends_with("_observation") ? "observation_manager" : role;
}

std::string obituary(const Peer& peer) {
  const std::string words = last_words_of(peer);
  return fmt::format("{} {} while {}", peer.describe(), words.empty() ? "died" : "ended: " + words, peer.activity);
}

}  // namespace

std::string Peer::describe() const {
  const std::string program = program_of(role);
  return pid == 0 ? program : fmt::format("{} (pid {} on {})", program, pid, host);
}

std::string Peer::failure(const std::string& message) const {
  return fmt::format("{} failed while {}: {}", role, activity, message);
}

PeerDied::PeerDied(const Peer& peer) : RunError(obituary(peer)) {}

PeerSilent::PeerSilent(const Peer& peer, double limit, const std::string& hint)
    : RunError(fmt::format("{} gave no sign for {} s while {}{}", peer.describe(), limit, peer.activity, hint)) {}

}  // namespace tether::protocol
