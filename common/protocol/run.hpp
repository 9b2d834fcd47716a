#pragma once

#include <functional>
#include <string>

#include "common/protocol/launch.hpp"
#include "common/protocol/local_channel.hpp"
#include "common/protocol/serve_together.hpp"

/// The main functions of the executables.
namespace tether::protocol {

/// A master's main: runs `body`, writes the one message of what went wrong to stderr ("fsi_master: ..."), ends
/// everything. Returns the exit code: 0 done, 1 the run failed, 2 the input is wrong.
/// `communicator`: Session's.
int run_master(const std::string& role, const std::function<void(Session&)>& body, const OfCase& of_case = {},
               int communicator = no_communicator);

namespace detail {
int run_either(const std::string& role, const std::function<void(Session&)>& as_master,
               const std::function<void(const Session::Link&, Session&)>& as_partner, const OfCase& of_case);
void refuse(Channel& master);
}  // namespace detail

/// The main of a program that is a partner if it has a master, and else a master: the one or the other of the above.
template <class Requests, class Build>
int run_either(const std::string& role, const std::function<void(Session&)>& as_master, Build build,
               const OfCase& of_case = {}) {
  const auto as_partner = [&build](const Session::Link& link, Session& session) {
    const auto built = [&] {
      if constexpr (std::is_invocable_v<Build, const Welcome&, Session&>)
        return build(link.welcome, session);
      else
        return build(link.welcome);
    };
    using Handler = decltype(built());
    std::unique_ptr<Handler> handler;
    try {
      handler.reset(new Handler(built()));
    } catch (...) {
      return detail::refuse(*link.channel);
    }
    serve<Requests>(*link.channel, handler->hello(), *handler);
  };
  return detail::run_either(role, as_master, as_partner, of_case);
}

/// A partner that lives in the process of its master. `build(program, welcome)` does what `build` does below.
template <class Requests, class Build>
Here partner_here(Build build) {
  return [build](const Program& program, const Welcome& welcome) -> std::unique_ptr<Channel> {
    using Handler = decltype(build(program, welcome));
    try {
      return local_channel<Requests>(program.role, std::shared_ptr<Handler>(new Handler(build(program, welcome))));
    } catch (...) {
      return std::make_unique<LocalChannel>(program.role, pack(detail::current_failure()), nullptr);
    }
  };
}

/// A partner's main. `build(welcome)` reads the case and returns the handler: `Hello hello()` and one call operator for
/// each message of `Requests` (serve.hpp). A partner that is a master itself takes `build(welcome, session)`. What
/// `build` throws is reported by the master.
template <class Requests, class Build>
int run_partner(const std::string& role, Build build, const OfCase& of_case = {}) {
  return run_either<Requests>(role, nullptr, std::move(build), of_case);
}

/// The main of a partner that may run in several processes, all of which compute: `build(welcome, team)`.
template <class Requests, class Build>
int run_partner_together(const std::string& role, Build build, const OfCase& of_case = {}) {
  using Handler = decltype(build(std::declval<const Welcome&>(), std::declval<Team&>()));
  const auto body = [&](Session& session) {
    if (!session.is_alone()) {
      std::optional<Session::Link> link;
      if (session.is_leader()) link = session.connect();
      ServeTogether<Requests, Handler> together(role, session, link);
      const Welcome welcome = together.welcome();
      return together([&] { return std::unique_ptr<Handler>(new Handler(build(welcome, together.team()))); });
    }
    const Session::Link link = session.connect();
    std::unique_ptr<Handler> handler;
    try {
      handler.reset(new Handler(build(link.welcome, alone())));
    } catch (...) {
      return detail::refuse(*link.channel);
    }
    serve<Requests>(*link.channel, handler->hello(), *handler);
  };
  return run_master(role, body, of_case, one_masters);
}

}  // namespace tether::protocol
