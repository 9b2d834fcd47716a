#pragma once

#include <concepts>
#include <exception>
#include <new>
#include <string>

#include "common/base/process.hpp"
#include "common/protocol/channel.hpp"

namespace tether::protocol {

/// A handler that turns a request into its reply.
template <class Handler, class Request>
concept Answers = requires(Handler& handler, const Request& request) {
  { handler(request) } -> std::same_as<typename Request::Reply>;
};

namespace detail {

/// The exception being handled, as a reply.
Failure current_failure();

template <class Handler, class... Requests>
Packet answer(std::variant<Requests...>*, const Packet& request, Handler& handler) {
  static_assert((Answers<Handler, Requests> && ...), "a request has no handler, or one with another reply");
  if constexpr (!(std::same_as<Requests, GetUsage> || ...))
    if (holds<GetUsage>(request)) return pack(Usage{cpu_seconds(), peak_memory_mb()});
  Packet reply;
  const bool known = ((holds<Requests>(request) && (reply = pack(handler(unpack<Requests>(request))), true)) || ...);
  return known ? std::move(reply) : pack(Failure{"does not know " + kind_name<ToPartner>(request.kind)});
}

}  // namespace detail

/// The reply to one request. `Requests`: ToFluid, ToSolid, ToObservation, ToGroup, ToRunService: each must have a
/// handler, a function `Request::Reply operator()(const Request&)`. Throws what the handler throws.
template <class Requests, class Handler>
Packet reply_to(const Packet& request, Handler& handler) {
  return detail::answer(static_cast<Requests*>(nullptr), request, handler);
}

/// The same; what a handler throws becomes Failure, but for std::bad_alloc: that memory is lacking says nothing of the
/// request, and whoever lacks it cannot go on.
template <class Requests, class Handler>
Packet answer(const Packet& request, Handler& handler) {
  try {
    return reply_to<Requests>(request, handler);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) {
    return pack(detail::current_failure());
  }
}

/// A partner's life after Welcome: says hello, then answers until Stop. If the master dies the process is ended
/// (Watch::follow).
template <class Requests, class Handler>
void serve(Channel& master, const Hello& hello, Handler& handler) {
  master.send(pack(hello));
  Packet request;
  do {
    request = master.receive();
    master.send(answer<Requests>(request, handler));
  } while (!holds<Stop>(request));
  if (unpack<Stop>(request).abrupt)
    master.flush();
  else
    master.close(exit_done);
}

}  // namespace tether::protocol
