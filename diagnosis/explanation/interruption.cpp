#include "diagnosis/explanation/interruption.hpp"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "common/base/error.hpp"

namespace tether {
namespace {

void end(int) {
  constexpr std::string_view message = "\ntether: interrupted; the same command goes on from here\n";
  if (write(STDERR_FILENO, message.data(), message.size()) < 0) _exit(exit_run_failed);
  _exit(exit_run_failed);
}

}  // namespace

void say_when_interrupted() {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, end);
}

}  // namespace tether
