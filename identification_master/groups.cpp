#include "identification_master/groups.hpp"

#include <algorithm>

#include "common/base/process.hpp"
#include "common/protocol/nodes.hpp"
#include "identification_master/group_memory.hpp"

namespace tether {

using protocol::Partner;

namespace {

std::size_t cores() {
  return static_cast<std::size_t>(usable_cores());
}

std::size_t hosts() {
  return std::max<std::size_t>(1, protocol::nodes_of_job().size());
}

std::size_t groups_that_fit(const VesselMesh& vessel, int cores_of_model) {
  const auto nodes = static_cast<std::size_t>(vessel.fluid.points.cols() + vessel.wall.points.cols());
  return hosts() * std::max<std::size_t>(1, std::min(cores() / static_cast<std::size_t>(cores_of_model),
                                                     groups_within(available_memory(), nodes)));
}

}  // namespace

std::size_t cores_of_job() {
  return hosts() * cores();
}

std::size_t group_count(const GroupsWanted& wanted, const protocol::Session& session) {
  if (const auto offered = session.offered("fsi_master")) return *offered;
  return std::min(wanted.most, wanted.wanted > 0 ? static_cast<std::size_t>(wanted.wanted)
                                                 : groups_that_fit(wanted.vessel(), wanted.cores_of_model));
}

std::vector<Partner*> launch_groups(std::size_t count, const std::filesystem::path& case_file,
                                    const std::filesystem::path& output, protocol::Session& session) {
  const protocol::Program program{"fsi_master", "fsi_master", {std::filesystem::absolute(case_file).string()}};
  std::vector<protocol::Program> programs(count, program);
  if (const std::vector<std::string> nodes = protocol::nodes_of_job(); !nodes.empty())
    for (std::size_t k = 0; k < count; ++k) programs[k].node = nodes[k % nodes.size()];
  std::vector<Partner*> groups;
  for (Partner& group : session.launch(programs, output.string())) groups.push_back(&group);
  for (Partner* group : groups) group->hello();
  return groups;
}

}  // namespace tether
