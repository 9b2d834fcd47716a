#pragma once

#include <map>
#include <string>
#include <vector>

/// Runs a job of fakes as a user would, for the tests of failure.
namespace tether::tests {

struct JobResult {
  int exit_code = -1;  ///< 128 + signal if a signal ended it, as a shell says
  double seconds = 0;
  double seconds_after_fault = 0;  ///< from the fault that a fake was told to make to the end; 0 without one
  std::string output, errors;      ///< stdout, stderr
  std::vector<int> orphans;        ///< the job's programs that still run 10 s after its end
};

using Environment = std::map<std::string, std::string>;

/// `command`: words; the program is looked for in PATH. Ends everything after `limit` seconds.
JobResult run_job(const std::vector<std::string>& command, const Environment& extra = {}, double limit = 20);

/// Seconds until nothing of the last job runs any more, Open MPI's orted and the reaper included; at most 10.
double seconds_until_empty();

/// build/tests/NAME, or build/bin/NAME
std::string test_program(const std::string& name);
std::string product_program(const std::string& name);

/// "mpirun" and the flags that docs/protocol.md recommends.
std::vector<std::string> mpirun();

}  // namespace tether::tests
