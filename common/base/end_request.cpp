#include "common/base/end_request.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "common/base/limits.hpp"
#include "common/base/process.hpp"

namespace tether {
namespace {

const char* file = nullptr;
unsigned limit = 0;

/// Calls nothing but what a signal's handler may.
void note(int) {
  const int made = open(file, O_WRONLY | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (made >= 0) close(made);
  alarm(limit);
}

void interrupt(int) {
  raise(SIGTERM);
}

}  // namespace

EndRequests::EndRequests() {
  std::error_code none;  // where there is no folder for it, programs are interrupted
  const std::filesystem::path folder = std::filesystem::temp_directory_path(none);
  static const std::string path = (folder / ("tether-end-" + std::to_string(process_id()))).string();
  file = path.c_str();
  limit = static_cast<unsigned>(std::max(1.0, end_limit()));
  unlink(file);
  setenv(end_request_variable, file, 1);
  std::signal(SIGALRM, interrupt);
  std::signal(SIGUSR1, note);
}

EndRequests::~EndRequests() {
  std::signal(SIGUSR1, SIG_IGN);
  alarm(0);
  unlink(file);
}

bool end_is_requested() {
  const char* told = std::getenv(end_request_variable);
  return told != nullptr && access(told, F_OK) == 0;
}

}  // namespace tether
