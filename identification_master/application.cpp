#include "identification_master/application.hpp"

#include <sched.h>

#include <chrono>
#include <iostream>

#include "common/base/process.hpp"
#include "common/base/progress_line.hpp"
#include "common/config/case_essence.hpp"
#include "common/config/echo.hpp"
#include "common/config/output_folder.hpp"
#include "common/observation/observed_case.hpp"
#include "common/protocol/run.hpp"
#include "common/protocol/signals.hpp"
#include "identification_master/checkpoint.hpp"
#include "identification_master/diagnosis_runs.hpp"
#include "identification_master/estimate_files.hpp"
#include "identification_master/group_pool.hpp"
#include "identification_master/identification_case.hpp"
#include "identification_master/identified_case.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;
using protocol::Partner;
using Clock = std::chrono::steady_clock;

/// A case and what of it an identification reads.
struct IdentifiedCase {
  explicit IdentifiedCase(const fs::path& path) : file(path) {
    file.read("mesh", mesh);
    file.read("observations", observations);
    file.read("identification", identification);
    file.read("diagnosis", diagnosis);
    file.finish();
    if (is_diagnosis()) return;
    if (!observations.has_lumen_data() && observations.traces.empty())
      throw input_error("{}: names no measurements to learn from", file.where("observations"));
    if (identification.parameters.empty())
      throw input_error("{}: names no parameters to be found", file.where("identification.parameters"));
  }
  /// The wall's element does not matter: interface nodes are the same.
  LumenSurface lumen() const { return lumen_of(load_mesh(mesh, file.units(), WallElement::prism)); }
  /// Prepared by tether diagnose: whole runs are wanted instead.
  bool is_diagnosis() const { return diagnosis.runs != "none"; }
  std::size_t particles() const { return identification.parameters.size() + 1; }

  CaseFile file;
  MeshCase mesh;
  ObservationsCase observations;
  IdentificationCase identification;
  DiagnosisCase diagnosis;
};

IdentificationPlan plan_of(const IdentifiedCase& given, const CommandLine& command) {
  const TimeCase& time = given.file.common().time;
  IdentificationPlan plan;
  plan.start = time.start;
  plan.dt = time.step;
  plan.steps = command.steps.value_or(time.steps());
  plan.every_step = given.identification.observe == "every_step";
  plan.reject_beyond = given.identification.reject_beyond;
  plan.memory_time = given.identification.memory_time;
  plan.largest_shift = given.identification.largest_shift;
  return plan;
}

std::size_t cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return sched_getaffinity(0, sizeof set, &set) == 0 ? static_cast<std::size_t>(CPU_COUNT(&set)) : 1;
}

/// Groups that share the particles: what the mpirun line holds, what the user wants, or a group for each core.
std::size_t group_count(const IdentifiedCase& given, const CommandLine& command, const protocol::Session& session) {
  if (const auto offered = session.offered("fsi_master")) return *offered;
  const int wanted = command.processes > 0 ? command.processes : given.identification.groups;
  const std::size_t most = given.is_diagnosis() ? cores() : given.particles();
  return std::min(most, wanted > 0 ? static_cast<std::size_t>(wanted) : std::max<std::size_t>(1, cores()));
}

std::vector<Partner*> launch_groups(std::size_t count, const fs::path& case_file, const fs::path& output,
                                    protocol::Session& session) {
  const protocol::Program program{"fsi_master", "fsi_master", {fs::absolute(case_file).string()}};
  std::vector<Partner*> groups;
  for (Partner& group : session.launch(std::vector<protocol::Program>(count, program), output.string()))
    groups.push_back(&group);
  for (Partner* group : groups) group->hello();
  return groups;
}

std::string news(const Identification& now, const IdentifiedParameters& parameters) {
  const EstimateRecord& last = now.last();
  std::string text = fmt::format("t {:.4g} s ", last.time);
  for (std::size_t i = 0; i < parameters.list().size(); ++i) {
    const IdentifiedParameter& p = parameters.list()[i];
    const auto k = static_cast<Eigen::Index>(i);
    const ValueEstimate value = estimate_of(p, last.mean(k), std::sqrt(last.covariance(k, k)));
    text += fmt::format(" {} {:.3g} ({:.3g} .. {:.3g})", p.name, value.median, value.lower, value.upper);
  }
  return text;
}

/// One identification from the launch of the groups to its files.
class Job {
 public:
  Job(IdentifiedCase& given, const CommandLine& command, GroupPool& pool, fs::path output)
      : given_(given),
        command_(command),
        pool_(pool),
        output_(std::move(output)),
        data_(load_observations(given.observations, given.lumen(), given.file)),
        parameters_(given.identification, pool.model().parameters, given.file),
        precision_(data_, pool.lumen(), given.file.common().time.step,
                   {given.file.common().time.start, given.file.common().time.end}),
        plan_(plan_of(given, command)),
        filter_(plan_, parameters_, prepared(), data_.traces, pool) {
    check_noise(data_, given.file);
    fingerprint_ = hash_case(echo_json("observations", given.observations), hash_case(pool.model().effective_case, 0));
    fingerprint_ = hash_case(echo_json("identification", given.identification), fingerprint_);
  }

  void run() {
    begin();
    ProgressLine progress(filter_.state().step, plan_.steps, command_.quiet);
    const auto begun = Clock::now();
    const double cpu_before = pool_.usage().cpu_seconds;
    master_cpu_before_ = cpu_seconds();
    try {
      while (!filter_.is_done()) {
        filter_.advance();
        progress.show(filter_.state().step, news(filter_, parameters_));
        if (filter_.state().step % given_.file.common().output.checkpoint_every == 0) save();
      }
    } catch (const protocol::Interrupted& interrupted) {
      progress.end_line();
      throw run_error("{} in step {}\n{}", interrupted.what(), filter_.state().step + 1, what_is_saved());
    } catch (const RunError& error) {
      progress.end_line();
      throw run_error("{}\n{}", error.what(), what_is_saved());
    }
    save();
    write_identified_case(output_ / "identified.yaml", given_.file, parameters_, filter_.last().mean);
    write_estimate(output_ / "estimate.json", parameters_, filter_, facts(seconds_since(begun), cpu_before));
  }

 private:
  const DataPrecision& prepared() {
    if (!plan_.every_step) precision_.count_frames_whole();
    return precision_;
  }
  void begin() {
    if (command_.resume) filter_.restore(read_checkpoint(output_, fingerprint_));
    if (command_.quiet) return;
    for (const std::string& notice : pool_.model().notices) std::cout << notice << "\n";
    std::cout << fmt::format("{} parameters, {} particles on {} groups of processes\n", parameters_.list().size(),
                             given_.particles(), pool_.size())
              << std::flush;
  }
  void save() {
    write_estimates(output_ / "estimate.csv", parameters_, filter_.state().records);
    write_checkpoint(output_, fingerprint_, filter_.state());
    saved_ = filter_.state().step;
  }
  std::string what_is_saved() const {
    if (!saved_) return "No state is saved yet";
    return fmt::format("The state after {} steps is in {}", *saved_, (output_ / "checkpoint").string());
  }
  IdentificationFacts facts(double wall_seconds, double cpu_before) {
    const CommonCase& common = given_.file.common();
    const protocol::Usage groups = pool_.usage();
    return {.case_name = common.name,
            .title = common.title,
            .case_file = fs::absolute(given_.file.path()).string(),
            .groups = pool_.size(),
            .wall_seconds = wall_seconds,
            .cpu_seconds = groups.cpu_seconds - cpu_before,
            .master_cpu_seconds = cpu_seconds() - master_cpu_before_,
            .peak_memory_mb = groups.peak_memory_mb + peak_memory_mb(),
            .notices = pool_.model().notices};
  }

  IdentifiedCase& given_;
  const CommandLine& command_;
  GroupPool& pool_;
  fs::path output_;
  Observations data_;
  IdentifiedParameters parameters_;
  DataPrecision precision_;
  IdentificationPlan plan_;
  Identification filter_;
  std::uint64_t fingerprint_ = 0;
  std::optional<std::int64_t> saved_;
  double master_cpu_before_ = 0;
};

void diagnose(const IdentifiedCase& given, const CommandLine& command, GroupPool& pool, const fs::path& output) {
  const auto& numbers = pool.model().parameters;
  const bool is_trial = given.diagnosis.runs == "trials";
  const auto runs =
      is_trial ? trial_runs(numbers, given.diagnosis, given.file) : sensitivity_runs(numbers, given.diagnosis, given.file);
  const int steps = command.steps.value_or(given.file.common().time.steps());
  make_runs(pool, runs, given.file, output, steps, command.quiet);
}

int run(const CommandLine& command) {
  return protocol::run_master("identification_master", [&command](protocol::Session& session) {
    IdentifiedCase given(command.case_file);
    const fs::path output = fs::absolute(claim_output(command, given.file));
    const std::vector<Partner*> groups =
        launch_groups(group_count(given, command, session), command.case_file, output, session);
    GroupPool pool(session, groups);
    if (given.is_diagnosis())
      diagnose(given, command, pool, output);
    else
      Job(given, command, pool, output).run();
    for (Partner* group : groups) group->stop("the identification is done");
  });
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
            DiagnosisCase diagnosis;
            fields.group("identification", identification, meaning_of_section("identification"));
            fields.group("diagnosis", diagnosis, meaning_of_section("diagnosis"));
          },
      .validate = [](const CommandLine& command) { IdentifiedCase given(command.case_file); },
      .run = run};
}

}  // namespace tether
