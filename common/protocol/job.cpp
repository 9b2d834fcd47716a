#include "common/protocol/job.hpp"

#include <sys/prctl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "common/base/process.hpp"

namespace tether::protocol {

namespace {

using Pids = std::vector<std::int64_t>;

/// Whether the process started with `entry` in its environment. False for processes of other users.
bool has_environment_entry(const std::filesystem::path& process, const std::string& entry) {
  std::ifstream file(process / "environ");
  const std::string environment{std::istreambuf_iterator<char>(file), {}};
  const auto place = environment.find(entry + '\0');
  return place != std::string::npos && (place == 0 || environment[place - 1] == '\0');
}

std::string name_of(std::int64_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/comm");
  std::string name;
  std::getline(file, name);
  return name;
}

std::int64_t parent_of(const std::filesystem::path& process) {
  std::ifstream file(process / "stat");
  std::string line;
  std::getline(file, line);
  const auto name_end = line.rfind(')');  // "pid (name) state parent ..."
  return name_end == std::string::npos || name_end + 4 > line.size() ? 0 : std::atoll(line.c_str() + name_end + 4);
}

template <class Condition>
Pids processes(Condition condition) {
  Pids pids;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc", error)) {
    const std::int64_t pid = std::atoll(entry.path().filename().c_str());
    if (pid > 0 && condition(entry.path()) && is_running(pid)) pids.push_back(pid);
  }
  return pids;
}

bool is_launcher(const std::string& program) {
  return program == "mpirun" || program == "mpiexec" || program == "orterun" || program == "orted";
}

const pid_t parent_at_start = getppid();
const bool was_launched = is_launcher(name_of(parent_at_start));

/// Open MPI's processes behind this one: the mpirun or orted that started it, or the orted that it has itself started
/// to spawn without mpirun.
Pids launchers() {
  const std::string parent = name_of(getppid());
  Pids pids = processes([](const auto& process) {
    return parent_of(process) == process_id() && name_of(std::atoll(process.filename().c_str())) == "orted";
  });
  if (is_launcher(parent)) pids.push_back(getppid());
  return pids;
}

/// Until the process has ended and its parent knows how: three seconds at most, since it may wait itself for what is to
/// be killed.
void await_end_of(pid_t pid) {
  for (int i = 0; i < 60 && kill(pid, 0) == 0; ++i) usleep(50'000);
}

/// The reaper's life: only calls that are allowed after a fork in a program with threads. `scratch`: what an mpirun
/// that has to be killed leaves on disk.
[[noreturn]] void reap(pid_t master, const Pids& pids, Pids& launchers, const char* scratch) {
  setsid();
  prctl(PR_SET_NAME, "tether-reaper");
  close_range(0, ~0U, 0);  // mpirun waits for the end of the pipes and sockets that were inherited
  usleep(500'000);
  await_end_of(master);  // mpirun's exit code is that of whom it sees end first
  for (const std::int64_t pid : pids) kill(static_cast<pid_t>(pid), SIGKILL);
  bool waiting = true;
  for (int i = 0; i < 25 && waiting; ++i) {
    usleep(100'000);
    waiting = false;
    for (std::int64_t& pid : launchers) {
      if (pid != 0 && kill(static_cast<pid_t>(pid), 0) != 0) pid = 0;
      waiting = waiting || pid != 0;
    }
  }
  for (const std::int64_t pid : launchers)
    if (pid != 0) kill(static_cast<pid_t>(pid), SIGKILL);
  if (waiting && scratch != nullptr) execl("/bin/rm", "rm", "-rf", scratch, nullptr);
  _exit(0);
}

}  // namespace

std::string mark_of_children() {
  return fmt::format("{}={} {}", master_variable, host_name(), process_id());
}

Pids marked_children() {
  const std::string mark = mark_of_children();
  return processes([&](const auto& process) { return has_environment_entry(process, mark); });
}

Peer marking_master() {
  const char* text = std::getenv(master_variable);
  const std::string mark = text ? text : "";
  const auto space = mark.rfind(' ');
  if (space == std::string::npos) return {"the master"};
  return {"the master", mark.substr(0, space), std::atoll(mark.c_str() + space + 1)};
}

bool launcher_is_gone() {
  return was_launched && getppid() != parent_at_start;
}

void leave_reaper(const Pids& pids) {
  Pids last = launchers();
  if (pids.empty() && last.empty()) return;
  const char* scratch = std::getenv("PMIX_SERVER_TMPDIR");
  const pid_t master = getpid();
  if (fork() == 0) reap(master, pids, last, scratch);
}

void end_job(int exit_code, const std::vector<Peer>& others) {
  Pids pids = marked_children();
  for (const Peer& peer : others)
    if (peer.pid > 0 && peer.host == host_name()) pids.push_back(peer.pid);
  leave_reaper(pids);
  std::fflush(nullptr);
  _exit(exit_code);
}

}  // namespace tether::protocol
