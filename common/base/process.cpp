#include "common/base/process.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

namespace tether {

namespace {

/// Vectors of a model's size come and go in each product. Those that the C library gives back to the system are mapped
/// and zeroed anew, page by page: a third of the master's time. What is larger, as factors are, is still given back.
void keep_memory() {
  constexpr int largest = 16 << 20;
  mallopt(M_MMAP_THRESHOLD, largest);
  mallopt(M_TRIM_THRESHOLD, 4 * largest);
}

}  // namespace

void prepare_process() {
  keep_memory();
  setenv("OMP_NUM_THREADS", "1", 1);
  setenv("OPENBLAS_NUM_THREADS", "1", 1);
  cpu_set_t all;
  CPU_ZERO(&all);
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) CPU_SET(cpu, &all);
  sched_setaffinity(0, sizeof all, &all);
  setenv("PATH", "/usr/local/bin:/usr/bin:/bin", 0);  // without one, mpirun and gnuplot find nothing
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error of the call that writes, which is told
  // A closed standard stream would be the next file's number.
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(standard, F_GETFD) < 0 && open("/dev/null", O_RDWR) != standard) break;
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](timeval t) { return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

int usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

std::string host_name() {
  char name[256] = {};
  gethostname(name, sizeof name - 1);
  return name;
}

std::int64_t process_id() {
  return getpid();
}

/// Fields of /proc/PID/stat as in proc(5): behind the name in parentheses the state, then numbers, the 12th and 13th of
/// them the ticks in user and system mode.
ProcessStatus status_of(std::int64_t pid) {
  if (kill(static_cast<pid_t>(pid), 0) != 0) return {};
  ProcessStatus status{true};
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  std::getline(stat, line);
  const auto name_end = line.rfind(')');
  if (name_end == std::string::npos) return status;
  std::istringstream fields(line.substr(name_end + 1));
  char state = ' ';
  fields >> state;
  status.runs = state != 'Z';
  status.is_stopped = state == 'T';
  double number = 0, ticks = 0;
  for (int field = 1; field <= 12 && fields >> number; ++field)
    if (field >= 11) ticks += number;
  status.cpu_seconds = ticks / static_cast<double>(sysconf(_SC_CLK_TCK));
  return status;
}

bool is_running(std::int64_t pid) {
  return status_of(pid).runs;
}

}  // namespace tether
