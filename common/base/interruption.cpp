#include "common/base/interruption.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstring>

#include "common/base/error.hpp"

namespace tether {
namespace {

std::atomic<const char*> told_way_on = nullptr;

void tell(const char* text) {
  if (write(STDERR_FILENO, text, std::strlen(text)) < 0) _exit(exit_run_failed);
}

/// Calls nothing but what a signal's handler may.
void end(int) {
  if (isatty(STDERR_FILENO) == 1) tell("\n");  // behind ^C
  tell("tether: interrupted");
  if (const char* way_on = told_way_on) {
    tell("; ");
    tell(way_on);
  }
  tell("\n");
  _exit(exit_run_failed);
}

}  // namespace

void end_when_interrupted() {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, end);
  if (std::signal(SIGHUP, end) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
}

WhenInterrupted::WhenInterrupted(const char* way_on) : tells_(told_way_on == nullptr) {
  if (tells_) told_way_on = way_on;
}

bool WhenInterrupted::is_told() {
  return told_way_on != nullptr;
}

WhenInterrupted::~WhenInterrupted() {
  if (tells_) told_way_on = nullptr;
}

InterruptionsWait::InterruptionsWait() {
  sigset_t waiting;
  sigemptyset(&waiting);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&waiting, signal);
  pthread_sigmask(SIG_BLOCK, &waiting, &before_);
}

InterruptionsWait::~InterruptionsWait() {
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace tether
