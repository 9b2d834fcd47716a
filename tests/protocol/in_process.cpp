#include "tests/protocol/in_process.hpp"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>

namespace tether::protocol {

namespace {

/// Packets on their way in one direction.
class Queue {
 public:
  void push(Packet packet) {
    const std::lock_guard lock(mutex_);
    packets_.push_back(std::move(packet));
    changed_.notify_one();
  }
  Packet pop(const Peer& peer, double limit) {
    std::unique_lock lock(mutex_);
    const std::chrono::duration<double> patience(std::min(limit, 1e6));
    if (!changed_.wait_for(lock, patience, [this] { return !packets_.empty(); })) throw PeerSilent(peer, limit);
    Packet packet = std::move(packets_.front());
    packets_.pop_front();
    return packet;
  }
  bool has_packet() {
    const std::lock_guard lock(mutex_);
    return !packets_.empty();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Packet> packets_;
};

class ThreadChannel final : public Channel {
 public:
  ThreadChannel(const Peer& peer, std::shared_ptr<Queue> out, std::shared_ptr<Queue> in)
      : Channel(peer), out_(std::move(out)), in_(std::move(in)) {}
  void send(Packet packet) override { out_->push(std::move(packet)); }
  Packet receive(double limit) override { return in_->pop(peer(), limit); }
  bool has_packet() override { return in_->has_packet(); }
  void flush() override {}
  void close(int) override {}

 private:
  std::shared_ptr<Queue> out_, in_;
};

}  // namespace

std::pair<std::unique_ptr<Channel>, std::unique_ptr<Channel>> thread_channel(const Peer& first, const Peer& second) {
  const auto there = std::make_shared<Queue>(), back = std::make_shared<Queue>();
  return {std::make_unique<ThreadChannel>(second, there, back), std::make_unique<ThreadChannel>(first, back, there)};
}

}  // namespace tether::protocol
