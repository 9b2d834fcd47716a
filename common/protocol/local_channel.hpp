#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>

#include "common/protocol/channel.hpp"
#include "common/protocol/serve.hpp"

namespace tether::protocol {

/// The way to a partner that lives in this process: it answers as it is asked. Its usage is the processor's time that
/// its answers took, and the memory of this process.
class LocalChannel final : public Channel {
 public:
  using Answer = std::function<Packet(const Packet&)>;
  /// first: what it says unasked, Hello or Failure.
  LocalChannel(const std::string& role, Packet first, Answer answer);

  void send(Packet packet) override;
  Packet receive(double limit = infinite) override;
  bool has_packet() override { return !replies_.empty(); }
  void flush() override {}
  void close(int exit_code) override;
  bool is_here() const override { return true; }

 private:
  Answer answer_;
  std::deque<Packet> replies_;
  double cpu_seconds_ = 0;
};

/// To a handler as `serve` wants it, which has `Hello hello()`.
template <class Requests, class Handler>
std::unique_ptr<Channel> local_channel(const std::string& role, std::shared_ptr<Handler> handler) {
  return std::make_unique<LocalChannel>(
      role, pack(handler->hello()), [handler](const Packet& request) { return answer<Requests>(request, *handler); });
}

}  // namespace tether::protocol
