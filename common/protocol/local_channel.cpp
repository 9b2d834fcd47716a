#include "common/protocol/local_channel.hpp"

#include <utility>

#include "common/base/process.hpp"

namespace tether::protocol {

LocalChannel::LocalChannel(const std::string& role, Packet first, Answer answer)
    : Channel(Peer{role}), answer_(std::move(answer)) {
  replies_.push_back(std::move(first));
}

void LocalChannel::send(Packet packet) {
  TETHER_ASSERT(answer_, "{} is asked after its end", peer().role);
  if (holds<GetUsage>(packet)) return replies_.push_back(pack(Usage{cpu_seconds_, peak_memory_mb()}));
  const double before = cpu_seconds();
  replies_.push_back(answer_(packet));
  cpu_seconds_ += cpu_seconds() - before;
}

Packet LocalChannel::receive(double) {
  TETHER_ASSERT(!replies_.empty(), "{} was asked nothing", peer().role);
  Packet first = std::move(replies_.front());
  replies_.pop_front();
  return first;
}

void LocalChannel::close(int) {
  answer_ = nullptr;
}

}  // namespace tether::protocol
