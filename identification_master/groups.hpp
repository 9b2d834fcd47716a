#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "common/mesh/mesh.hpp"
#include "common/protocol/launch.hpp"

namespace tether {

/// What the number of groups of processes depends on.
struct GroupsWanted {
  int wanted = 0;                      ///< by the user; 0: what the machines can hold
  std::size_t most = 1;                ///< that would have something to do
  int cores_of_model = 1;              ///< that each keeps busy
  std::function<VesselMesh()> vessel;  ///< of the model, asked for where the user wants no number
};

/// Cores that this process may use, on each host of the job: they are taken to be alike.
std::size_t cores_of_job();

/// Groups that share the work: what the mpirun line holds, what the user wants, or as many as the cores and the memory
/// have room for.
std::size_t group_count(const GroupsWanted& wanted, const protocol::Session& session);

/// Starts fsi_masters with their codes on a case; all have said hello. output: for files of the codes.
std::vector<protocol::Partner*> launch_groups(std::size_t count, const std::filesystem::path& case_file,
                                              const std::filesystem::path& output, protocol::Session& session);

}  // namespace tether
