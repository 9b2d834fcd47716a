#pragma once

#include <filesystem>
#include <functional>
#include <memory>

#include "common/protocol/channel.hpp"

namespace tether::protocol {

/// The environment variable that tells an identification_master where somebody listens who wants runs.
inline constexpr const char* run_service_socket = "TETHER_RUN_SERVICE";
/// And in which folder are the runs that it shares with others, if it does.
inline constexpr const char* shared_runs = "TETHER_SHARED_RUNS";

/// Packets through a Unix socket: int64 kind, int64 length, the bytes. Waiting takes no time of a core; that the other
/// process has ended, in whatever way, is noticed at once.
class SocketChannel final : public Channel {
 public:
  /// The channel becomes the owner of a connected socket.
  SocketChannel(Peer peer, int descriptor) : Channel(std::move(peer)), descriptor_(descriptor) {}
  ~SocketChannel() override;
  /// Waits while the other end does not read. Throws PeerDied.
  void send(Packet packet) override;
  /// Throws PeerSilent, PeerDied, Interrupted (after report_signals).
  Packet receive(double limit) override;
  bool has_packet() override;
  void flush() override {}
  void close(int exit_code) override;
  /// Whether the other end is closed: its process has ended, or the channel has.
  bool is_left() const;

 private:
  void write(const void* data, std::size_t size);
  void read(void* data, std::size_t size, double limit);

  int descriptor_;
};

/// A place where one process of this user on this host may connect.
class SocketListener {
 public:
  /// In a folder of its own below the folder for temporary files. Throws RunError.
  SocketListener();
  ~SocketListener();
  SocketListener(const SocketListener&) = delete;
  SocketListener& operator=(const SocketListener&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Waits for the process, and looks ten times a second whether it may still come; nothing if not. When it has come
  /// the path is gone, so that nothing stays behind a process that is killed.
  std::unique_ptr<SocketChannel> accept(const Peer& peer, const std::function<bool()>& may_come) const;

 private:
  void remove_path() const;

  std::filesystem::path path_;
  int descriptor_ = -1;
};

/// The other end. Throws RunError if nobody listens there.
std::unique_ptr<SocketChannel> connect_to(const Peer& peer, const std::filesystem::path& path);

}  // namespace tether::protocol
