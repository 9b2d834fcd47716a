#pragma once

#include <array>
#include <optional>

#include "common/protocol/company.hpp"
#include "common/protocol/serve.hpp"

namespace tether::protocol {

/// A partner's life in several processes: each has a handler, and all answer each request; the leader's answers go to
/// the master.
template <class Requests, class Handler>
class ServeTogether {
 public:
  ServeTogether(const std::string& role, Session& session, std::optional<Session::Link>& link)
      : session_(session), link_(link), company_(role, session) {}

  Team& team() { return company_.team(); }
  /// What the master has told the leader on its arrival.
  Welcome welcome() { return unpack<Welcome>(company_.shared(link_ ? pack(link_->welcome) : Packet{})); }

  /// `build`: makes the handler, or throws.
  template <class Build>
  void operator()(const Build& build) {
    if (link_) return live(build);
    try {
      live(build);
    } catch (const std::exception& error) {  // nobody waits for it, and the others cannot go on
      company_.give_up(error.what());
    }
  }

 private:
  template <class Build>
  void live(const Build& build) {
    std::unique_ptr<Handler> handler;
    const Packet failure = attempt([&] {
      handler = build();
      return Packet{};
    });
    const Packet refusal = agreed(failure);
    if (link_) link_->channel->send(holds<Failure>(refusal) ? refusal : pack(handler->hello()));
    if (holds<Failure>(refusal)) return take_leave(exit_run_failed);
    Packet request;
    do {
      request = company_.shared(link_ ? link_->channel->receive() : Packet{});
      const Packet reply = agreed(answer_with_usage(request, *handler));
      if (link_) link_->channel->send(reply);
    } while (!holds<Stop>(request));
    company_.part();
    handler.reset();
    if (!unpack<Stop>(request).abrupt) return take_leave(exit_done);
    if (link_) link_->channel->flush();
  }
  template <class Work>
  static Packet attempt(const Work& work) {
    try {
      return work();
    } catch (const std::bad_alloc&) {
      throw;
    } catch (...) {
      return pack(detail::current_failure());
    }
  }
  Packet answer_with_usage(const Packet& request, Handler& handler) {
    if (!holds<GetUsage>(request)) return answer<Requests>(request, handler);
    std::array used{cpu_seconds(), peak_memory_mb()};
    company_.team().sum(used);
    return pack(Usage{used[0], used[1]});
  }
  /// This process's packet, unless work on it has failed in another one only.
  Packet agreed(Packet mine) {
    const std::string elsewhere = company_.settled(holds<Failure>(mine) ? unpack<Failure>(mine).message : "");
    return holds<Failure>(mine) || elsewhere.empty() ? std::move(mine) : pack(Failure{elsewhere, false});
  }
  void take_leave(int code) {
    if (!link_) return;  // Session::end does it
    session_.gather_processes();
    link_->channel->close(code);
  }

  Session& session_;
  std::optional<Session::Link>& link_;
  Company company_;
};

}  // namespace tether::protocol
