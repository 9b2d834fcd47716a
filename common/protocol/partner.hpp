#pragma once

#include <memory>
#include <string>

#include "common/base/limits.hpp"
#include "common/protocol/channel.hpp"

namespace tether::protocol {

/// A partner answered Failure: it is still reachable, so the step may be retried.
struct PartnerFailed : RunError {
  using RunError::RunError;
};

/// A remote code (fluid, solid, observation_manager) as its master sees it: questions and answers.
///
///   const Load load = fluid.ask(FluidEvaluate{displacement, velocity});
///
/// or, so that two codes work at the same time: a.send(...); b.send(...); a.receive<Load>(); b.receive<Motion>().
/// Errors: InputError or PartnerFailed if the partner answers Failure, PeerDied if it is gone; all name role and step.
class Partner {
 public:
  explicit Partner(std::unique_ptr<Channel> channel) : channel_(std::move(channel)) {}
  Partner(Partner&&) = default;
  Partner& operator=(Partner&&) = delete;

  const std::string& role() const { return channel_->peer().role; }
  const Peer& peer() const { return channel_->peer(); }
  bool is_here() const { return channel_->is_here(); }  ///< in this process
  /// What the partner is and can do. Waits for it the first time, at most `limit` seconds.
  const Hello& hello(double limit = setup_limit());

  template <class Request>
  typename Request::Reply ask(const Request& request) {
    send(request);
    return receive<typename Request::Reply>();
  }
  template <class Request>
  void send(const Request& request) {
    if constexpr (requires { request.step; }) step_ = request.step;
    post(Request::message_name, pack(request));
  }
  template <class Reply>
  Reply receive() {
    const Packet packet = take(infinite);
    if (!holds<Reply>(packet)) reject(packet, Reply::message_name);
    return unpack<Reply>(packet);
  }
  /// Whether `receive` would not wait.
  bool has_replied() const { return stage_ == Stage::busy && channel_->has_packet(); }
  /// The last request: lets the partner write what is open, at most `limit` seconds long.
  void finish(const Stop& stop, double limit = infinite);
  /// After `finish`: both ends of the channel close; see Channel.
  void close(int exit_code);
  /// Finish and close.
  void stop(const std::string& reason);

  bool is_idle() const { return stage_ == Stage::idle; }  ///< waits for a request
  bool is_finished() const { return stage_ == Stage::finished || stage_ == Stage::closed; }

 private:
  enum class Stage { starting, idle, busy, finished, closed, lost };

  void post(const char* request_name, Packet packet);
  Packet take(double limit);
  /// Throws what the packet means instead of the `expected` reply.
  [[noreturn]] void reject(const Packet& packet, const char* expected) const;

  std::unique_ptr<Channel> channel_;
  Hello hello_;
  Stage stage_ = Stage::starting;
  std::int64_t step_ = -1;
};

}  // namespace tether::protocol
