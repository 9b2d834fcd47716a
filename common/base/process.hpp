#pragma once

#include <cstdint>
#include <string>

namespace tether {

/// One BLAS thread, all cores allowed (mpirun binds single-process jobs to one core, often the same). Call first in
/// main.
void prepare_process();

double cpu_seconds();     ///< user + system time of this process [s]
double peak_memory_mb();  ///< largest resident set so far [MB]
int usable_cores();       ///< of this host, by this process
std::string host_name();
std::int64_t process_id();

/// What a process of this host is at.
struct ProcessStatus {
  bool runs = false;        ///< it is there; a zombie does not run
  bool is_stopped = false;  ///< by a signal, until SIGCONT; not by a debugger that traces it
  double cpu_seconds = 0;   ///< user + system time so far [s]
};
ProcessStatus status_of(std::int64_t pid);

/// Whether process `pid` runs on this host. A zombie does not.
bool is_running(std::int64_t pid);

}  // namespace tether
