#include "common/base/child_process.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>

#include "common/base/error.hpp"
#include "common/base/limits.hpp"

namespace tether {
namespace {

constexpr int cannot_execute = 127;

/// A file in memory: what a child writes into it is read when the child has ended.
class Capture {
 public:
  Capture() : descriptor_(memfd_create("capture", MFD_CLOEXEC)) {
    if (descriptor_ < 0) throw run_error("no memory for the output of a program: {}", std::strerror(errno));
  }
  ~Capture() { close(descriptor_); }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  int descriptor() const { return descriptor_; }
  std::string text() const {
    std::string all(static_cast<std::size_t>(lseek(descriptor_, 0, SEEK_END)), '\0');
    std::size_t have = 0;
    for (ssize_t count = 1; count > 0 && have < all.size();
         have += static_cast<std::size_t>(std::max<ssize_t>(count, 0)))
      count = pread(descriptor_, all.data() + have, all.size() - have, static_cast<off_t>(have));
    return all;
  }

 private:
  int descriptor_;
};

/// In the child: becomes the program, or ends with `cannot_execute` and the error number in `failure`.
[[noreturn]] void execute(const Command& command, int failure) {
  for (const auto& [name, value] : command.environment) setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> words;
  for (const auto& word : command.words) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execvp(words.front(), words.data());
  const int number = errno;
  if (write(failure, &number, sizeof number) < 0) _exit(cannot_execute);
  _exit(cannot_execute);
}

/// In the child: it takes all signals, also where whoever started the parent let it wait with some, and ends with its
/// parent, also with one that has died meanwhile, or dies before the child is its program and while it still has the
/// parent's way of taking a signal.
void take_signals_and_end_with(pid_t parent) {
  sigset_t none;
  sigemptyset(&none);
  if (std::signal(SIGTERM, SIG_DFL) == SIG_IGN) std::signal(SIGTERM, SIG_IGN);
  pthread_sigmask(SIG_SETMASK, &none, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) _exit(cannot_execute);
}

/// Forks; the child, which ends with this process, runs `prepare` and becomes the program. Returns the child's pid.
pid_t start(const Command& command, const std::function<void()>& prepare) {
  std::array<int, 2> failure{};
  if (pipe2(failure.data(), O_CLOEXEC) != 0) throw run_error("no pipe: {}", std::strerror(errno));
  const pid_t parent = getpid(), pid = fork();
  if (pid == 0) {
    take_signals_and_end_with(parent);
    prepare();
    execute(command, failure[1]);
  }
  close(failure[1]);
  int number = 0;
  const bool failed = pid < 0 || read(failure[0], &number, sizeof number) > 0;
  close(failure[0]);
  if (failed && pid > 0) waitpid(pid, nullptr, 0);
  if (failed)
    throw run_error("{} cannot be started: {}", command.words.front(), std::strerror(pid < 0 ? errno : number));
  return pid;
}

int exit_code_in(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Waits until it ends or is stopped by a signal; returns what waitpid has.
int change_of(pid_t pid) {
  int status = 0;
  while (waitpid(pid, &status, WUNTRACED) < 0)
    if (errno != EINTR) return 0;
  return status;
}

/// Waits for its end, which it returns as waitpid has it; tells on stderr when it is stopped.
int end_of(pid_t pid, const std::string& name) {
  int status = 0;
  while (WIFSTOPPED(status = change_of(pid)))
    fmt::print(stderr, "{} (pid {}) is stopped: kill -CONT {} lets it go on\n", name, pid, pid);
  return status;
}

/// Whether it goes on or ends; how it ended is left to be asked.
bool changes_within(double seconds, pid_t pid) {
  constexpr useconds_t between_looks = 50'000;
  for (double waited = 0; waited < seconds; waited += 1e-6 * between_looks) {
    siginfo_t change{};
    if (waitid(P_PID, static_cast<id_t>(pid), &change, WEXITED | WCONTINUED | WNOHANG | WNOWAIT) != 0 ||
        change.si_pid != 0)
      return true;
    usleep(between_looks);
  }
  return false;
}

/// The same of one that may not be stopped for long.
int end_soon_of(pid_t pid, const std::string& name) {
  int status = 0;
  while (WIFSTOPPED(status = change_of(pid))) {
    if (changes_within(stopped_limit(), pid)) continue;
    kill(pid, SIGKILL);
    waitpid(pid, nullptr, 0);
    throw run_error("{} (pid {}) was stopped, and still was {:g} s later (TETHER_STOPPED_LIMIT=SECONDS waits longer)",
                    name, pid, stopped_limit());
  }
  return status;
}

volatile std::sig_atomic_t foreground_child = 0, handed_on = 0;
std::atomic<double> handed_on_at = 0;  ///< seconds; 0: never

double now() {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// One that comes from several sides, as to a whole group and to each process of it, is one: of a second one mpirun
/// ends at once and leaves its programs behind.
void forward(int signal) {
  constexpr double at_once = 1;  // seconds
  const bool again = handed_on == signal && now() - handed_on_at < at_once;
  handed_on = signal;
  if (again || foreground_child <= 0) return;
  handed_on_at = now();
  kill(foreground_child, signal);
}

/// While this lives, the signals that end a program go to the child; that of a terminal that is closed does not where
/// it is ignored (nohup).
class Forwarding {
 public:
  Forwarding() {
    handed_on = 0;
    struct sigaction action {};
    action.sa_handler = forward;
    for (std::size_t i = 0; i < signals.size(); ++i) {
      sigaction(signals[i], &action, &before_[i]);
      if (signals[i] == SIGHUP && before_[i].sa_handler == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
    }
  }
  ~Forwarding() {
    foreground_child = 0;
    for (std::size_t i = 0; i < signals.size(); ++i) sigaction(signals[i], &before_[i], nullptr);
  }

 private:
  static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};
  std::array<struct sigaction, 3> before_{};
};

/// In the child: a process group of its own, so that Ctrl-C reaches it once, through its parent; no input.
void detach_from_terminal() {
  setpgid(0, 0);
  dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
}

}  // namespace

std::string how_it_ended(int exit_code) {
  if (exit_code <= 128 || exit_code - 128 >= NSIG) return fmt::format("ended with {}", exit_code);
  return fmt::format("was ended by signal {} ({})", exit_code - 128, strsignal(exit_code - 128));
}

std::string last_line(const std::string& text) {
  const auto end = text.find_last_not_of('\n');
  if (end == std::string::npos) return {};
  const auto before = text.rfind('\n', end);
  return text.substr(before + 1, end - before);  // npos + 1: from the beginning
}

ChildEnd capture(const Command& command) {
  const Capture output, errors;
  const pid_t pid = start(command, [&] {
    dup2(output.descriptor(), STDOUT_FILENO);
    dup2(errors.descriptor(), STDERR_FILENO);
  });
  const int status = end_soon_of(pid, command.words.front());
  return {exit_code_in(status), output.text(), errors.text()};
}

ChildEnd capture_in_foreground(const Command& command) {
  const Forwarding forwarding;
  const Capture output, errors;
  const pid_t pid = start(command, [&] {
    detach_from_terminal();
    dup2(output.descriptor(), STDOUT_FILENO);
    dup2(errors.descriptor(), STDERR_FILENO);
  });
  foreground_child = pid;
  const int status = end_soon_of(pid, command.words.front());
  return {exit_code_in(status), output.text(), errors.text(), handed_on};
}

ForegroundEnd run_in_foreground(const Command& command) {
  const Forwarding forwarding;
  const pid_t pid = start(command, detach_from_terminal);
  foreground_child = pid;
  const StoppedChildren children(pid, command.words.front(), [] { return handed_on != 0; });
  const int status = end_of(pid, command.words.front());
  return {exit_code_in(status), WIFSIGNALED(status), handed_on, children.were_killed()};
}

RunningProgram::RunningProgram(const Command& command)
    : name_(command.words.front()),
      pid_(start(command, detach_from_terminal)),
      children_(pid_, name_, [] { return false; }) {}

RunningProgram::~RunningProgram() {
  if (exit_code()) return;
  kill(pid_, SIGTERM);
  wait();
}

std::optional<int> RunningProgram::exit_code() {
  int status = 0;
  if (!code_ && waitpid(pid_, &status, WNOHANG) == pid_) code_ = exit_code_in(status);
  return code_;
}

int RunningProgram::wait() {
  if (!code_) code_ = exit_code_in(end_of(pid_, name_));
  return *code_;
}

}  // namespace tether
