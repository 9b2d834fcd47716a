#include "common/protocol/socket_channel.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>

#include "common/base/temporary_folder.hpp"
#include "common/protocol/signals.hpp"

namespace tether::protocol {

namespace {

constexpr int look_again = 100;  // milliseconds

RunError socket_error(const std::string& what, const std::filesystem::path& path) {
  return run_error("{} {}: {}", what, path.string(), std::strerror(errno));
}

int new_socket(const std::filesystem::path& path) {
  const int descriptor = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) throw socket_error("no socket for", path);
  return descriptor;
}

sockaddr_un address_of(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string text = path.string();
  if (text.size() >= sizeof address.sun_path)
    throw run_error("{} is too long for a socket; set TMPDIR to a shorter folder", text);
  text.copy(address.sun_path, text.size());
  return address;
}

/// Whether the socket is ready for one of `events` within so many milliseconds (-1: however long it takes, or until a
/// signal).
bool is_ready(int descriptor, short events, int milliseconds) {
  pollfd asked{descriptor, events, 0};
  return poll(&asked, 1, milliseconds) > 0;
}

/// False if the limit passed [s]. After a signal it is asked again and again whether that ends the wait.
bool wait_for_bytes(int descriptor, double limit) {
  const auto start = std::chrono::steady_clock::now();
  const auto left = [&] {
    return limit - std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  while (true) {
    const double patience = std::min(left(), interrupted() ? 1e-3 * look_again : infinite);
    if (is_ready(descriptor, POLLIN, patience > 1e6 ? -1 : static_cast<int>(1e3 * std::max(patience, 0.0))))
      return true;
    check_interrupted();
    if (left() <= 0) return false;
  }
}

}  // namespace

SocketChannel::~SocketChannel() {
  close(exit_done);
}

void SocketChannel::close(int) {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

void SocketChannel::send(Packet packet) {
  const std::array<std::int64_t, 2> head{packet.kind, static_cast<std::int64_t>(packet.bytes.size())};
  write(head.data(), sizeof head);
  write(packet.bytes.data(), packet.bytes.size());
}

Packet SocketChannel::receive(double limit) {
  std::array<std::int64_t, 2> head{};
  read(head.data(), sizeof head, limit);
  if (head[1] < 0 || static_cast<std::size_t>(head[1]) > largest_message)
    throw MalformedMessage(fmt::format("a packet of {} bytes", head[1]));
  Packet packet{static_cast<int>(head[0]), Bytes(static_cast<std::size_t>(head[1]))};
  read(packet.bytes.data(), packet.bytes.size(), infinite);
  return packet;
}

bool SocketChannel::has_packet() {
  return is_ready(descriptor_, POLLIN, 0);
}

bool SocketChannel::is_left() const {
  pollfd asked{descriptor_, POLLRDHUP, 0};
  return poll(&asked, 1, 0) > 0;
}

void SocketChannel::write(const void* data, std::size_t size) {
  const auto* next = static_cast<const std::byte*>(data);
  while (size > 0) {
    const ssize_t count = ::send(descriptor_, next, size, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw PeerDied(peer());
    next += count;
    size -= static_cast<std::size_t>(count);
  }
}

void SocketChannel::read(void* data, std::size_t size, double limit) {
  auto* next = static_cast<std::byte*>(data);
  while (size > 0) {
    if (!wait_for_bytes(descriptor_, limit)) throw PeerSilent(peer(), limit);
    const ssize_t count = ::recv(descriptor_, next, size, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw PeerDied(peer());
    next += count;
    size -= static_cast<std::size_t>(count);
  }
}

SocketListener::SocketListener() {
  std::string folder = (temporary_folder() / "tether_runs_XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) throw socket_error("no folder", folder);
  path_ = std::filesystem::path(folder) / "socket";
  const sockaddr_un address = address_of(path_);
  descriptor_ = new_socket(path_);
  if (bind(descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      listen(descriptor_, 1) != 0)
    throw socket_error("nobody can connect to", path_);
}

SocketListener::~SocketListener() {
  if (descriptor_ >= 0) ::close(descriptor_);
  remove_path();
}

void SocketListener::remove_path() const {
  std::error_code ignored;
  std::filesystem::remove_all(path_.parent_path(), ignored);
}

std::unique_ptr<SocketChannel> SocketListener::accept(const Peer& peer, const std::function<bool()>& may_come) const {
  while (!is_ready(descriptor_, POLLIN, look_again))
    if (!may_come()) return nullptr;
  const int connected = accept4(descriptor_, nullptr, nullptr, SOCK_CLOEXEC);
  if (connected < 0) throw socket_error("nobody came to", path_);
  remove_path();
  return std::make_unique<SocketChannel>(peer, connected);
}

std::unique_ptr<SocketChannel> connect_to(const Peer& peer, const std::filesystem::path& path) {
  const sockaddr_un address = address_of(path);
  const int descriptor = new_socket(path);
  auto channel = std::make_unique<SocketChannel>(peer, descriptor);
  if (connect(descriptor, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    throw socket_error("nobody listens at", path);
  return channel;
}

}  // namespace tether::protocol
