#include "common/protocol/signals.hpp"

#include <unistd.h>

#include <csignal>

namespace tether::protocol {

namespace {

using Handler = void (*)(int);

volatile std::sig_atomic_t signal_seen = 0;

void note(int signal) {
  signal_seen = signal;
}

void end_later(int) {
  alarm(1);
}

/// Unless the host code handles the signal itself. The second signal finds the default action.
void handle_once(int signal, Handler handler) {
  struct sigaction old {
  }, action{};
  if (sigaction(signal, nullptr, &old) != 0) return;
  if (old.sa_handler != SIG_DFL && old.sa_handler != end_later && old.sa_handler != note) return;
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(signal, &action, nullptr);
}

}  // namespace

void report_signals() {
  handle_once(SIGINT, note);
  handle_once(SIGTERM, note);
}

bool interrupted() {
  return signal_seen != 0;
}

void delay_termination() {
  handle_once(SIGINT, SIG_DFL);
  handle_once(SIGTERM, end_later);
}

}  // namespace tether::protocol
