#pragma once

#include <filesystem>
#include <string>

#include "common/base/child_process.hpp"
#include "common/config/command_line.hpp"

namespace tether {

/// The program of that name beside this one. Throws InputError if there is none.
std::filesystem::path sibling(const std::string& name);

/// The mpirun line that starts a master (fsi_master, identification_master) on a case. Open MPI is told that there may
/// be more processes than cores, that none is to be bound to one, to say nothing of its own when a run fails, and, for
/// the superuser, that this is meant.
Command parallel_run(const std::string& master, const CommandLine& command);

/// The master says why a run failed, unless it was killed itself: mpirun ends with 128 and the signal's number if any
/// process was. Says so if the master could not, or that a person interrupted it, and how to go on from what is saved;
/// returns the front-end's exit code.
int report_failure(const ForegroundEnd& end, const std::string& master, const char* verb, const CommandLine& command);

/// Runs a master to its end. Throws ToldFailure as `report_failure` says.
void run_to_end(const std::string& master, const char* verb, const CommandLine& command);

}  // namespace tether
