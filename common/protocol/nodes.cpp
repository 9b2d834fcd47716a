#include "common/protocol/nodes.hpp"

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <list>
#include <memory>
#include <sstream>

#include "common/base/error.hpp"

namespace tether::protocol {

namespace {

constexpr const char *ssh = "22", *any_port = nullptr;

/// Null: the name is nobody's.
std::shared_ptr<addrinfo> address_of(const std::string& node, const char* port) {
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  if (getaddrinfo(node.c_str(), port, &hints, &found) != 0) return nullptr;
  return {found, freeaddrinfo};
}

/// A connection that is being made, and whether it is known already how that ends.
class Call {
 public:
  explicit Call(const std::string& node) {
    const std::shared_ptr<addrinfo> at = address_of(node, ssh);
    if (!at) return;
    descriptor_ = socket(at->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (descriptor_ >= 0) error_ = connect(descriptor_, at->ai_addr, at->ai_addrlen) == 0 ? 0 : errno;
  }
  ~Call() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  void wait(int milliseconds) {
    if (error_ != EINPROGRESS) return;
    pollfd ready{descriptor_, POLLOUT, 0};
    if (poll(&ready, 1, milliseconds) <= 0) return;
    socklen_t size = sizeof error_;
    getsockopt(descriptor_, SOL_SOCKET, SO_ERROR, &error_, &size);
  }
  bool is_answered() const { return error_ == 0 || error_ == ECONNREFUSED; }

 private:
  int descriptor_ = -1, error_ = EHOSTUNREACH;
};

}  // namespace

std::vector<std::string> nodes_of_job() {
  const char* text = std::getenv(nodes_variable);
  std::string given = text == nullptr ? "" : text;
  std::replace(given.begin(), given.end(), ',', ' ');
  std::istringstream list(given);
  std::vector<std::string> nodes{std::istream_iterator<std::string>(list), {}};
  constexpr const char* letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_";
  for (const std::string& node : nodes) {
    if (node.find_first_not_of(letters) != std::string::npos)
      throw input_error("{}: {}: names of hosts with commas between them, n1,n2, and nothing else", nodes_variable,
                        node);
    if (std::count(nodes.begin(), nodes.end(), node) > 1) throw input_error("{}: {} twice", nodes_variable, node);
  }
  if (nodes.empty() && !given.empty()) throw input_error("{}: names no host", nodes_variable);
  if (nodes.size() == 1) nodes.clear();
  return nodes;
}

bool is_here(const std::string& node) {
  const std::shared_ptr<addrinfo> at = address_of(node, any_port);
  if (!at) return false;
  const int descriptor = socket(at->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const bool here = descriptor >= 0 && bind(descriptor, at->ai_addr, at->ai_addrlen) == 0;
  if (descriptor >= 0) close(descriptor);
  return here;
}

std::string own_node() {
  const std::vector<std::string> nodes = nodes_of_job();
  if (nodes.empty()) return {};
  const char* own = std::getenv(node_variable);
  return own == nullptr ? nodes.front() : own;
}

bool is_on_first_node() {
  const std::vector<std::string> nodes = nodes_of_job();
  return nodes.empty() || own_node() == nodes.front();
}

std::vector<std::string> silent_nodes(const std::vector<std::string>& nodes, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  std::list<Call> calls;  // all at once: they wait together
  for (const std::string& node : nodes) calls.emplace_back(node);
  std::vector<std::string> silent;
  auto node = nodes.begin();
  for (Call& call : calls) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    call.wait(static_cast<int>(std::max<std::int64_t>(0, left.count())));
    if (!call.is_answered()) silent.push_back(*node);
    ++node;
  }
  return silent;
}

}  // namespace tether::protocol
