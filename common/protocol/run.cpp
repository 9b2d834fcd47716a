#include "common/protocol/run.hpp"

#include <cstdio>
#include <new>

#include "common/protocol/signals.hpp"
#include "common/protocol/told.hpp"

namespace tether::protocol {

namespace {

void tell(const std::string& role, const std::string& message, Told what = Told::failure) {
  fmt::print(stderr, "{}: {}\n", role, message);
  std::fflush(stderr);
  note_told(what);
}

/// The exit code of `body`, its error reported.
int guarded(const std::string& role, const std::function<void()>& body) {
  try {
    body();
    return exit_done;
  } catch (const InputError& error) {
    tell(role, error.what());
    return exit_input_wrong;
  } catch (const Interrupted& interrupted) {
    tell(role, interrupted.what(), Told::interruption);
    return exit_run_failed;
  } catch (const std::bad_alloc&) {
    tell(role, "it gets no more memory than it has (std::bad_alloc)");
    return exit_run_failed;
  } catch (const std::exception& error) {
    tell(role, error.what());
    return exit_run_failed;
  }
}

}  // namespace

int run_master(const std::string& role, const std::function<void(Session&)>& body, const OfCase& of_case,
               int communicator) {
  std::unique_ptr<Session> session;
  const int code = guarded(role, [&] {
    session = std::make_unique<Session>(role, communicator, of_case);
    body(*session);
  });
  return session ? session->end(code) : code;
}

namespace detail {

int run_either(const std::string& role, const std::function<void(Session&)>& as_master,
               const std::function<void(const Session::Link&, Session&)>& as_partner, const OfCase& of_case) {
  const auto life = [&](Session& session) {
    if (as_master && !session.has_master()) return as_master(session);
    const Session::Link link = session.connect();
    as_partner(link, session);
  };
  return run_master(role, life, of_case);
}

void refuse(Channel& master) {
  master.send(pack(current_failure()));
  master.close(exit_run_failed);
}

}  // namespace detail

}  // namespace tether::protocol
