#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/protocol/channel.hpp"

/// The processes that a master has started on this host, found without MPI: a spawned process carries the environment
/// variable TETHER_MASTER="HOST PID" of its master from its first instruction.
namespace tether::protocol {

inline constexpr const char* master_variable = "TETHER_MASTER";

/// "TETHER_MASTER=HOST PID" of this process, for the environment of what it spawns.
std::string mark_of_children();

/// Running processes of this host with that mark.
std::vector<std::int64_t> marked_children();

/// The master that spawned this process, from its own environment; pid 0 if it was not spawned.
Peer marking_master();

/// Whether the mpirun or orted that started this process has ended.
bool launcher_is_gone();

/// Leaves a process behind that ends `pids` half a second later, and not before this process's exit code has reached
/// mpirun; at the latest after three and a half seconds. An mpirun that still runs three seconds after that is ended
/// too: it may hang in its own end when a process of its job died.
void leave_reaper(const std::vector<std::int64_t>& pids);

/// Ends this process now, without MPI_Finalize; then `others` and all marked children that still run half a second
/// later, or when its exit code is known.
[[noreturn]] void end_job(int exit_code, const std::vector<Peer>& others = {});

}  // namespace tether::protocol
