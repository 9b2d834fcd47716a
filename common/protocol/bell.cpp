#include "common/protocol/bell.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <string>

#include "common/base/process.hpp"

namespace tether::protocol {

namespace {

struct Address {
  sockaddr_un value{};
  socklen_t size = 0;
};

/// A name without a file (unix(7), abstract): nothing is left of it when the process ends.
Address address_of(std::int64_t pid) {
  Address address;
  address.value.sun_family = AF_UNIX;
  const std::string name = '\0' + fmt::format("tether-{}", pid);
  name.copy(address.value.sun_path, name.size());
  address.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
  return address;
}

}  // namespace

Bell& Bell::own() {
  static Bell bell;
  return bell;
}

Bell::Bell() : descriptor_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  const Address address = address_of(getpid());
  if (descriptor_ < 0 || bind(descriptor_, reinterpret_cast<const sockaddr*>(&address.value), address.size) == 0)
    return;
  close(descriptor_);
  descriptor_ = -1;
}

Bell::~Bell() {
  if (descriptor_ >= 0) close(descriptor_);
}

bool Bell::ring(const Peer& peer) const {
  static const std::string here = host_name();
  if (descriptor_ < 0 || peer.pid == 0 || peer.host != here) return false;
  const Address address = address_of(peer.pid);
  const char nothing = 0;
  return sendto(descriptor_, &nothing, 1, MSG_NOSIGNAL, reinterpret_cast<const sockaddr*>(&address.value),
                address.size) == 1 ||
         errno == EAGAIN;  // others have rung, and it has not looked yet
}

bool Bell::sleep(std::chrono::nanoseconds at_most) {
  pollfd asked{descriptor_, POLLIN, 0};  // a descriptor below zero is not looked at
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(at_most);
  const timespec limit{seconds.count(), (at_most - seconds).count()};
  if (ppoll(&asked, 1, &limit, nullptr) <= 0) return false;
  char nothing = 0;
  while (recv(descriptor_, &nothing, 1, 0) > 0) {
  }
  return true;
}

}  // namespace tether::protocol
