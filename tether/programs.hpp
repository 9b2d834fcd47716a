#pragma once

#include <filesystem>
#include <string>

#include "common/base/child_process.hpp"
#include "common/config/command_line.hpp"

namespace tether {

/// The program of that name beside this one. Throws InputError if there is none.
std::filesystem::path sibling(const std::string& name);

/// The mpirun line that simulates a case. Open MPI is told that there may be more processes than cores, that none is to
/// be bound to one, to say nothing of its own when a run fails, and, for the superuser, that this is meant.
Command coupled_run(const CommandLine& command);

}  // namespace tether
