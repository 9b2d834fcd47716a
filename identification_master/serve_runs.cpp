#include "identification_master/serve_runs.hpp"

#include <cstdlib>

#include "common/base/checked_file.hpp"
#include "common/base/error.hpp"
#include "common/config/case_tree.hpp"
#include "common/config/cores_of_model.hpp"
#include "common/config/echo.hpp"
#include "common/config/input_files.hpp"
#include "common/config/output_folder.hpp"
#include "common/protocol/guard.hpp"
#include "common/protocol/job.hpp"
#include "common/protocol/serve.hpp"
#include "common/protocol/socket_channel.hpp"
#include "identification_master/groups.hpp"
#include "identification_master/run_service.hpp"
#include "vessel/mesh_case.hpp"

namespace tether {
namespace {

using protocol::Partner;

constexpr double look_every = 0.1;  // seconds

/// A case of which runs are made.
struct ServedCase {
  explicit ServedCase(const std::filesystem::path& path) : file(path) {
    file.read("mesh", mesh);
    file.finish();
  }
  /// The wall's element does not matter: interface nodes are the same.
  VesselMesh vessel() const { return load_mesh(mesh, file, WallElement::prism); }
  CaseFile file;
  MeshCase mesh;
};

/// What a case says of a field of a section, as text.
std::string said_of(const YamlNode* section, std::string_view field) {
  const YamlNode* node = section == nullptr ? nullptr : section->find(field);
  return node == nullptr ? "" : yaml_text(*node);
}

/// Of all that a run depends on beside the values of its numbers: the model, its times, how and by which programs it is
/// solved, and what these programs are where they are not Tether's own.
std::string hash_of(const protocol::Hello& model, const CaseFile& file) {
  std::uint64_t hash = hash_case(model.effective_case, 0);
  for (const std::string& section : {echo_json("time", file.common().time), echo_json("image", file.common().image)})
    hash = hash_case(section, hash);
  const YamlNode tree = as_one_file(read_case_tree(file.path()));
  const std::string coupling = said_of(&tree, "coupling");
  hash = hash_bytes(coupling.data(), coupling.size(), hash);
  for (const InputFile& input : input_files(file.path()))
    if (input.field.starts_with("coupling.")) hash = hash_bytes(&input.content, sizeof input.content, hash);
  return fmt::format("{:016x}", hash);
}

/// Those of the environment, if it names a folder. Runs of other versions, with other solver settings or without the
/// columns of these points are not taken for these.
RunStore shared_runs(const CaseFile& file) {
  const char* folder = std::getenv(protocol::shared_runs);
  if (folder == nullptr) return {};
  const YamlNode tree = read_case_tree(file.path());
  return {folder, TETHER_VERSION + said_of(&tree, "coupling") + said_of(tree.find("output"), "points")};
}

/// Answers until Stop. What a handler throws ends the service; without a front-end it ends without a word, too.
void answer_all(protocol::Channel& front_end, RunService& service) {
  protocol::Packet request;
  const auto receive = [&] {
    try {
      return front_end.receive();
    } catch (const protocol::PeerDied&) {
      protocol::end_job(exit_run_failed);
    }
  };
  front_end.send(pack(service.hello()));
  do {
    request = receive();
    front_end.send(protocol::reply_to<protocol::ToRunService>(request, service));
  } while (!protocol::holds<protocol::Stop>(request));
}

}  // namespace

void serve_runs(const CommandLine& command, const std::filesystem::path& socket, protocol::Session& session) {
  const auto front_end = protocol::connect_to({"tether"}, socket);
  const protocol::Guard watch(look_every, [&](double) {
    if (front_end->is_left()) protocol::end_job(exit_run_failed);
  });
  const ServedCase given(command.case_file);
  const std::filesystem::path output = std::filesystem::absolute(claim_and_mark_output(command, given.file));
  const std::size_t count = group_count(
      {command.processes, cores_of_job(), cores_of_model(given.file), [&given] { return given.vessel(); }}, session);
  const std::vector<Partner*> groups = launch_groups(count, command.case_file, output, session);
  GroupRunMakers makers(session, groups);
  RunService service(makers, hash_of(makers.model(), given.file),
                     command.steps.value_or(given.file.common().time.steps()), shared_runs(given.file));
  answer_all(*front_end, service);
  for (Partner* group : groups) group->stop("no more runs are wanted");
}

}  // namespace tether
