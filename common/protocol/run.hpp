#pragma once

#include <functional>
#include <string>

#include "common/protocol/launch.hpp"
#include "common/protocol/serve.hpp"

/// The main functions of the executables.
namespace tether::protocol {

/// A master's main: runs `body`, writes the one message of what went wrong to stderr ("fsi_master: ..."), ends
/// everything. Returns the exit code: 0 done, 1 the run failed, 2 the input is wrong.
int run_master(const std::string& role, const std::function<void(Session&)>& body);

namespace detail {
int run_partner(const std::string& role, const std::function<void(Channel&, const Welcome&)>& life);
void refuse(Channel& master);
}  // namespace detail

/// A partner's main. `build(welcome)` reads the case and returns the handler: `Hello hello()` and one call operator for
/// each message of `Requests` (serve.hpp). What `build` throws is reported by the master.
template <class Requests, class Build>
int run_partner(const std::string& role, Build build) {
  return detail::run_partner(role, [&build](Channel& master, const Welcome& welcome) {
    using Handler = decltype(build(welcome));
    std::unique_ptr<Handler> handler;
    try {
      handler.reset(new Handler(build(welcome)));
    } catch (...) {
      return detail::refuse(master);
    }
    serve<Requests>(master, handler->hello(), *handler);
  });
}

}  // namespace tether::protocol
