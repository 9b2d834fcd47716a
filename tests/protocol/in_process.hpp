#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "common/protocol/partner.hpp"
#include "common/protocol/serve.hpp"

/// Partners without processes, for tests: of a master against fakes, of the serving loop in a thread.
namespace tether::protocol {

/// A channel whose other end is a function: `send` calls it, `receive` returns what it returned.
class DirectChannel final : public Channel {
 public:
  DirectChannel(const std::string& role, Packet hello, std::function<Packet(const Packet&)> answer)
      : Channel({role}), answer_(std::move(answer)), reply_(std::move(hello)) {}
  void send(Packet packet) override { reply_ = answer_(packet); }
  Packet receive(double) override { return std::move(reply_); }
  bool has_packet() override { return true; }
  void flush() override {}
  void close(int) override {}

 private:
  std::function<Packet(const Packet&)> answer_;
  Packet reply_;
};

/// A partner inside this process. `handler` is as in `serve` and has `Hello hello()`.
template <class Requests, class Handler>
Partner in_process_partner(const std::string& role, std::shared_ptr<Handler> handler) {
  const Packet hello = pack(handler->hello());
  Partner partner(std::make_unique<DirectChannel>(
      role, hello, [handler](const Packet& request) { return answer<Requests>(request, *handler); }));
  partner.hello();
  return partner;
}

/// The two ends of a channel between two threads.
std::pair<std::unique_ptr<Channel>, std::unique_ptr<Channel>> thread_channel(const Peer& first, const Peer& second);

}  // namespace tether::protocol
