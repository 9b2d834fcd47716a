#pragma once

#include <string>
#include <vector>

/// Who belongs to whom when one MPMD mpirun line starts all processes.
namespace tether::protocol {

/// The world rank of the master of `rank`, -1 if it has none. `roles`: by world rank; empty for a rank that only helps
/// its neighbour (the further ranks of a parallel code).
///
/// identification_master leads the fsi_masters, an fsi_master (or any other name that is no solver's) leads fluid,
/// solid and solid_observation. Of m masters and n processes of one role, each master gets n/m, in
/// rank order: the k-th fluid belongs to the k-th fsi_master. Throws InputError if m does not divide n.
int master_of(const std::vector<std::string>& roles, int rank);

/// Throws InputError if several processes lead and none leads them: each would make a run of its own.
void check_one_leads(const std::vector<std::string>& roles);

/// The world ranks that `rank` leads, in rank order. Throws InputError.
std::vector<int> partners_of(const std::vector<std::string>& roles, int rank);

}  // namespace tether::protocol
