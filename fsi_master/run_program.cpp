#include "fsi_master/run_program.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstring>

#include "common/base/error.hpp"

namespace tether {
namespace {

/// Starts the program with its stderr going to `pipe_end`.
pid_t start(const std::string& executable, const std::vector<std::string>& arguments, int pipe_end) {
  std::vector<char*> argv{const_cast<char*>(executable.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, pipe_end, STDERR_FILENO);
  pid_t pid = 0;
  const int error = posix_spawn(&pid, executable.c_str(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw run_error("{} cannot be started: {}", executable, std::strerror(error));
  return pid;
}

std::string read_to_end(int descriptor) {
  std::string text;
  std::array<char, 4096> buffer;
  for (ssize_t count; (count = read(descriptor, buffer.data(), buffer.size())) > 0;)
    text.append(buffer.data(), static_cast<std::size_t>(count));
  return text;
}

}  // namespace

ProgramEnd run_program(const std::string& executable, const std::vector<std::string>& arguments) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw run_error("no pipe: {}", std::strerror(errno));
  pid_t pid = 0;
  try {
    pid = start(executable, arguments, ends[1]);
  } catch (...) {
    close(ends[0]), close(ends[1]);
    throw;
  }
  close(ends[1]);
  ProgramEnd end{0, read_to_end(ends[0])};
  close(ends[0]);
  int status = 0;
  waitpid(pid, &status, 0);
  if (!WIFEXITED(status)) throw run_error("{} was killed by signal {}", executable, WTERMSIG(status));
  end.exit_code = WEXITSTATUS(status);
  return end;
}

}  // namespace tether
