#pragma once

#include <cstdint>
#include <string>

namespace tether {

/// One BLAS thread, all cores allowed (mpirun binds single-process jobs to one core, often the same). Call first in
/// main.
void prepare_process();

double cpu_seconds();     ///< user + system time of this process [s]
double peak_memory_mb();  ///< largest resident set so far [MB]
std::string host_name();
std::int64_t process_id();

/// Whether process `pid` runs on this host. A zombie does not.
bool is_running(std::int64_t pid);

}  // namespace tether
