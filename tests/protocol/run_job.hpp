#pragma once

#include <map>
#include <string>
#include <vector>

/// Runs a job of fakes as a user would, for the tests of failure.
namespace tether::tests {

struct JobResult {
  int exit_code = -1;            ///< 128 + signal if a signal ended it, as a shell says
  bool had_to_be_ended = false;  ///< it still ran at its limit
  std::string output, errors;    ///< stdout, stderr
  std::vector<int> orphans;      ///< the job's programs that still run a minute after its end
};

using Environment = std::map<std::string, std::string>;

/// `command`: words; the program is looked for in PATH. Ends everything after `limit` seconds.
JobResult run_job(const std::vector<std::string>& command, const Environment& extra = {}, double limit = 120);

/// Whether nothing of the last job runs any more, Open MPI's orted and the reaper included: waits a minute for it.
bool nothing_remains();

/// build/tests/NAME, or build/bin/NAME
std::string test_program(const std::string& name);
std::string product_program(const std::string& name);

/// "mpirun" and the flags that docs/protocol.md recommends.
std::vector<std::string> mpirun();

}  // namespace tether::tests
