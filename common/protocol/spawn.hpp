#pragma once

#include <mpi.h>

#include "common/protocol/launch.hpp"

/// Only for this room's .cpp files: MPI's blocking ways to another process, with a thread that ends the job if they
/// hang.
namespace tether::protocol {

/// Ends the job with `message` on stderr: a call inside MPI will not come back.
[[noreturn]] void give_up(const std::string& role, const std::string& message);

/// MPI_Init with what Open MPI must know before it. False if the host code has already done it.
bool initialise_mpi(const std::string& role);

struct Spawned {
  MPI_Comm communicator;
  Peer peer;  ///< pid 0 if it is not on this host
};

/// Starts the program. If it ends before it reaches MPI, or does not within start_limit(), the job ends with a message.
Spawned spawn(const Program& program, const std::string& master_role);

/// The way between a master and a partner of one MPMD line. `tag`: the partner's rank in MPI_COMM_WORLD.
MPI_Comm meet(int other_rank, int tag, const std::string& other_role, const std::string& own_role);

/// Throws RunError with MPI's own words if `code` is not MPI_SUCCESS.
void check_mpi(int code, const char* what);

/// Of this process, among those of the communicator.
int rank_in(MPI_Comm communicator);
int size_of(MPI_Comm communicator);

}  // namespace tether::protocol
