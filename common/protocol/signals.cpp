#include "common/protocol/signals.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <ctime>

namespace tether::protocol {

namespace {

constexpr double grace = 0.5;         // seconds
std::atomic<double> signal_time = 0;  // 0: none came
std::atomic<bool> ends_later = false;

double now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void note(int) {
  signal_time = now();
  if (ends_later) alarm(1);
}

/// Unless the host code handles the signal itself. The second signal finds the default action.
void note_once(int signal) {
  struct sigaction old {
  }, action{};
  if (sigaction(signal, nullptr, &old) != 0 || old.sa_handler != SIG_DFL) return;
  action.sa_handler = note;
  action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  sigaction(signal, &action, nullptr);
}

}  // namespace

void report_signals() {
  note_once(SIGINT);
  note_once(SIGTERM);
}

bool interrupted() {
  return signal_time != 0;
}

void check_interrupted() {
  if (interrupted() && now() - signal_time > grace) throw Interrupted();
}

void delay_termination() {
  ends_later = true;
  if (interrupted()) alarm(1);
  report_signals();
}

}  // namespace tether::protocol
