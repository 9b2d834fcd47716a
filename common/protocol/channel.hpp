#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "common/base/effect.hpp"
#include "common/protocol/packet.hpp"

namespace tether::protocol {

/// The process at the other end of a channel, as errors name it.
struct Peer {
  std::string role;
  std::string host = {};
  std::int64_t pid = 0;               ///< 0: not known yet, or this process
  std::string activity = "starting";  ///< what it was last asked to do: "computing step 12 (SolidEvaluate)"
  /// "solid (pid 1234 on node7)"
  std::string describe() const;
  /// "solid failed while computing step 12 (SolidEvaluate): MESSAGE"
  std::string failure(const std::string& message) const;
};

/// The other process is gone. Its channel must not be used any more.
struct PeerDied : RunError {
  explicit PeerDied(const Peer& peer);
};

/// The other process did not answer within the limit. `hint`: what a person can do about it.
struct PeerSilent : RunError {
  PeerSilent(const Peer& peer, double limit, const std::string& hint = "");
};

/// Two ends that exchange packets, in order. `send` does not wait for the other end, `receive` does.
class Channel {
 public:
  explicit Channel(Peer peer) : peer_(std::move(peer)) {}
  virtual ~Channel() = default;
  Channel(const Channel&) = delete;
  Channel& operator=(const Channel&) = delete;

  virtual void send(Packet packet) = 0;
  /// Waits at most `limit` seconds. Throws PeerSilent, PeerDied.
  virtual Packet receive(double limit = infinite) = 0;
  /// Whether `receive` would not wait.
  virtual bool has_packet() = 0;
  /// Waits until what was sent has left this process.
  virtual void flush() = 0;
  /// The orderly end: both ends call it after the last packet. Without it the channel is abandoned. If the other end
  /// does not call it for long, this process ends with the exit code.
  virtual void close(int exit_code) = 0;

  /// Whether the other end is in this process.
  virtual bool is_here() const { return false; }

  Peer& peer() { return peer_; }
  const Peer& peer() const { return peer_; }

 private:
  Peer peer_;
};

}  // namespace tether::protocol
