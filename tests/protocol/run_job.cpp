#include "tests/protocol/run_job.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#include "common/base/process.hpp"

namespace tether::tests {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void nap(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

std::string contents(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Running processes that inherited `mark` in their environment: exactly those of one job. Those that clean up behind
/// it (Open MPI's orted, our reaper) end themselves within 3 s and count only if asked for.
std::vector<int> marked_processes(const std::string& mark, bool with_cleaners = false) {
  std::vector<int> pids;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator("/proc", error)) {
    const int pid = std::atoi(entry.path().filename().c_str());
    if (pid <= 0 || contents(entry.path() / "environ").find(mark) == std::string::npos || !is_running(pid)) continue;
    const std::string name = contents(entry.path() / "comm");
    if (with_cleaners || (name != "orted\n" && name != "tether-reaper\n")) pids.push_back(pid);
  }
  return pids;
}

std::string last_mark;

[[noreturn]] void become(const std::vector<std::string>& command, const Environment& extra, const fs::path& folder) {
  for (const auto& [name, value] : extra) setenv(name.c_str(), value.c_str(), 1);
  if (!freopen((folder / "out").c_str(), "w", stdout) || !freopen((folder / "err").c_str(), "w", stderr)) _exit(126);
  std::vector<char*> words;
  for (const auto& word : command) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execvp(words[0], words.data());
  _exit(127);
}

constexpr double patience = 60;  // [s], for what takes a second where nothing else runs

/// Waits for the child; kills the whole job after `limit` seconds.
void wait_for(pid_t child, const std::string& mark, double limit, JobResult& result) {
  const auto start = Clock::now();
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    nap(0.005);
    if (seconds_since(start) < limit) continue;
    result.had_to_be_ended = true;
    for (const int pid : marked_processes(mark)) kill(pid, SIGKILL);
  }
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool empties(const std::string& mark, bool with_cleaners) {
  const auto start = Clock::now();
  while (!marked_processes(mark, with_cleaners).empty()) {
    if (seconds_since(start) > patience) return false;
    nap(0.05);
  }
  return true;
}

/// What is left all the same is ended here, so that no test leaves a process.
std::vector<int> remaining(const std::string& mark) {
  if (empties(mark, false)) return {};
  const auto orphans = marked_processes(mark);
  for (const int pid : orphans) kill(pid, SIGKILL);
  return orphans;
}

}  // namespace

JobResult run_job(const std::vector<std::string>& command, const Environment& extra, double limit) {
  static int count = 0;
  const std::string name = "tether-job-" + std::to_string(getpid()) + "-" + std::to_string(++count);
  const fs::path folder = fs::temp_directory_path() / name;
  fs::create_directories(folder);
  Environment environment = extra;
  environment["TETHER_TEST_JOB"] = name;
  environment["OMPI_ALLOW_RUN_AS_ROOT"] = environment["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1";
  const std::string mark = "TETHER_TEST_JOB=" + name + '\0';
  last_mark = mark;
  const pid_t child = fork();
  if (child == 0) become(command, environment, folder);
  JobResult result;
  wait_for(child, mark, limit, result);
  result.orphans = remaining(mark);
  result.output = contents(folder / "out");
  result.errors = contents(folder / "err");
  fs::remove_all(folder);
  return result;
}

bool nothing_remains() {
  return empties(last_mark, true);
}

std::string test_program(const std::string& name) {
  return fs::read_symlink("/proc/self/exe").parent_path() / name;
}

std::string product_program(const std::string& name) {
  return fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "bin" / name;
}

std::vector<std::string> mpirun() {
  return {"mpirun", "-q", "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1"};
}

}  // namespace tether::tests
