#include "common/protocol/signals.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <ctime>

namespace tether::protocol {

namespace {

using Handler = void (*)(int);

constexpr double grace = 0.5;         // seconds
std::atomic<double> signal_time = 0;  // 0: none came

double now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void note(int) {
  signal_time = now();
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
  return signal_time != 0;
}

void check_interrupted() {
  if (interrupted() && now() - signal_time > grace) throw Interrupted();
}

void delay_termination() {
  handle_once(SIGINT, SIG_DFL);
  handle_once(SIGTERM, end_later);
}

}  // namespace tether::protocol
