#pragma once

#include <string>
#include <vector>

/// Where a job that has several nodes runs its programs: a model, a master with fluid and solid, stays on one.
namespace tether::protocol {

/// In the environment: the nodes of the job, "n1,n2", as its script says (tether submit); and the one of this process.
inline constexpr const char* nodes_variable = "TETHER_NODES";
inline constexpr const char* node_variable = "TETHER_NODE";

/// The nodes of the job; nothing if there is one only, or nobody said. Throws InputError for what is no name of a host,
/// or is there twice.
std::vector<std::string> nodes_of_job();

/// Whether a node's address is one of this machine.
bool is_here(const std::string& node);

/// Where the partners of this process are to run: on its own node; the first process is on the first. Empty: wherever
/// MPI starts them.
std::string own_node();

/// Whether the job's first master sees this process: also if there is one node only.
bool is_on_first_node();

/// Those of the nodes that do not answer: a host that runs takes a connection to its ssh, or refuses it; one that is
/// lost does neither within the time [s].
std::vector<std::string> silent_nodes(const std::vector<std::string>& nodes, double seconds);

}  // namespace tether::protocol
