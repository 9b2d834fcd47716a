#include "identification_master/application.hpp"

#include <cstdlib>

#include "common/base/process.hpp"
#include "common/config/cores_of_model.hpp"
#include "common/config/input_files.hpp"
#include "common/config/output_folder.hpp"
#include "common/protocol/run.hpp"
#include "common/protocol/socket_channel.hpp"
#include "identification_master/checkpoint.hpp"
#include "identification_master/groups.hpp"
#include "identification_master/identification_job.hpp"
#include "identification_master/results/estimate.hpp"
#include "identification_master/serve_runs.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using protocol::Partner;

/// Asked for, or as many as before a continuation, so that it ends with the same results, or what the case says.
int wanted_groups(const IdentifiedCase& given, const CommandLine& command, const fs::path& output) {
  if (command.processes > 0) return command.processes;
  return command.resume ? static_cast<int>(groups_of_checkpoint(output)) : given.identification.groups;
}

std::size_t groups_for(const IdentifiedCase& given, int wanted, const protocol::Session& session) {
  return group_count({wanted, given.particles(), cores_of_model(given.file), [&given] { return given.vessel(); }},
                     session);
}

void run_identification(const CommandLine& command, protocol::Session& session) {
  IdentifiedCase given(command.case_file);
  const fs::path output = fs::absolute(claim_output(command, given.file));
  check_replaceable(output, "identify", {identified_file}, command.overwrite);
  const InputWatch inputs(command.case_file);
  const std::vector<Partner*> groups = launch_groups(groups_for(given, wanted_groups(given, command, output), session),
                                                     command.case_file, output, session);
  GroupPool pool(session, groups);
  identify(given, command, pool, output, inputs);
  for (Partner* group : groups) group->stop("the identification is done");
}

/// All but what the models announce: their numbers are known when they run.
void check(const CommandLine& command) {
  const IdentifiedCase given(command.case_file);
  earlier_of(given.identification);
  data_of(given);
}

/// What it is asked for: runs by a process that listens for it, else an identification.
int run(const CommandLine& command) {
  const auto life = [&command](protocol::Session& session) {
    const char* socket = std::getenv(protocol::run_service_socket);
    socket == nullptr ? run_identification(command, session) : serve_runs(command, socket, session);
  };
  return protocol::run_master("identification_master", life, [&command] { return hash_files_read(command.case_file); });
}

}  // namespace

Program identification_master_program() {
  prepare_process();
  return {
      .name = "identification_master",
      .purpose =
          "Finds parameters of a model from measurements during a run: p + 1 coupled models, corrected at every step.",
      .declare =
          [](Fields& fields) {
            IdentificationCase identification;
            fields.group("identification", identification, meaning_of_section("identification"));
          },
      .validate = check,
      .run = run,
      .shares_work = true};
}

}  // namespace tether
