#pragma once

#include <memory>
#include <utility>

#include "common/protocol/local_channel.hpp"
#include "common/protocol/partner.hpp"

/// Partners without processes, for tests: of a master against fakes, of the serving loop in a thread.
namespace tether::protocol {

/// A partner inside this process. `handler` is as in `serve` and has `Hello hello()`.
template <class Requests, class Handler>
Partner in_process_partner(const std::string& role, std::shared_ptr<Handler> handler) {
  Partner partner(local_channel<Requests>(role, std::move(handler)));
  partner.hello();
  return partner;
}

/// The two ends of a channel between two threads.
std::pair<std::unique_ptr<Channel>, std::unique_ptr<Channel>> thread_channel(const Peer& first, const Peer& second);

}  // namespace tether::protocol
