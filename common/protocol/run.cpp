#include "common/protocol/run.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>

namespace tether::protocol {

namespace {

/// The front-end learns from the file TETHER_TOLD, if it wants one, that a message was written.
void tell(const std::string& role, const std::string& message) {
  fmt::print(stderr, "{}: {}\n", role, message);
  std::fflush(stderr);
  if (const char* note = std::getenv("TETHER_TOLD")) std::ofstream(note) << role << "\n";
}

/// The exit code of `body`, its error reported.
int guarded(const std::string& role, const std::function<void()>& body) {
  try {
    body();
    return exit_done;
  } catch (const InputError& error) {
    tell(role, error.what());
    return exit_input_wrong;
  } catch (const std::exception& error) {
    tell(role, error.what());
    return exit_run_failed;
  }
}

}  // namespace

int run_master(const std::string& role, const std::function<void(Session&)>& body) {
  std::unique_ptr<Session> session;
  const int code = guarded(role, [&] {
    session = std::make_unique<Session>(role);
    body(*session);
  });
  return session ? session->end(code) : code;
}

namespace detail {

int run_either(const std::string& role, const std::function<void(Session&)>& as_master,
               const std::function<void(const Session::Link&, Session&)>& as_partner) {
  return run_master(role, [&](Session& session) {
    if (as_master && !session.has_master()) return as_master(session);
    const Session::Link link = session.connect();
    as_partner(link, session);
  });
}

void refuse(Channel& master) {
  master.send(pack(current_failure()));
  master.close(exit_run_failed);
}

}  // namespace detail

}  // namespace tether::protocol
