#include "tether/plan.hpp"

#include <algorithm>

#include "common/base/child_process.hpp"
#include "common/base/error.hpp"
#include "common/base/process.hpp"
#include "common/base/session_folder.hpp"
#include "common/config/cores_of_model.hpp"
#include "common/config/identified_parameters.hpp"
#include "common/io/record_file.hpp"
#include "common/protocol/programs.hpp"
#include "diagnosis/evidence/coarse_runs.hpp"
#include "diagnosis/evidence/living_runs.hpp"
#include "diagnosis/evidence/numerics.hpp"
#include "diagnosis/evidence/sensitivities.hpp"
#include "diagnosis/search/division.hpp"
#include "tether/verbs.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// A few, beyond the first, which is longer.
constexpr int steps_to_measure = 3;

MeasuredSteps measured(const fs::path& case_file) {
  const SessionFolder scratch("tether_measured");
  const fs::path output = scratch.path() / "run";
  const ChildEnd end =
      capture_in_foreground({{fs::read_symlink("/proc/self/exe").string(), "simulate", case_file.string(), "--steps",
                              std::to_string(steps_to_measure), "--output", output.string(), "--quiet"},
                             {{"TETHER_PICTURES", "0"}}});
  if (end.handed_on != 0) throw run_error("interrupted");
  if (end.exit_code != 0)
    throw run_error("{}: {} steps, to measure what they take, failed:\n{}", case_file.string(), steps_to_measure,
                    end.errors);
  const auto run = read_record<RunSummary>(output / "summary.json");
  return {run.steps, CaseFile(case_file).common().time.steps(), run.seconds_per_step, run.peak_memory_mb.at("total")};
}

int parameters_of(const fs::path& case_file) {
  return static_cast<int>(identified_parameters(case_file).size());
}

/// The runs that show what each number does, of those that the programs announce, and the models beside it.
void add_first_order(const fs::path& case_file, PlannedRuns& planned) {
  const DiagnosedCase given(case_file);
  const SessionFolder scratch("tether_planned");
  const fs::path candidates = scratch.path() / "candidates.yaml";
  const std::vector<PlacedEffect> effects = catalogue_of(given.file, given.diagnosis);
  write_candidates(candidates, given.file, given.data, effects);
  CommandLine command;
  command.processes = 1;
  command.quiet = true;
  const LivingRuns runs(command, candidates, scratch.path());
  const Division division(effects, varied_numbers(runs.parameters(), effects, given.diagnosis, given.file));
  planned.first_order = 1 + static_cast<int>(division.undivided().size());
  if (given.diagnosis.coarse) planned.coarser = measured(write_coarse(candidates, given));
  if (!given.asks_numerics()) return;
  for (const RefinedCase& refined : write_refined(candidates, given)) planned.finer.push_back(measured(refined.file));
}

void check_diagnosed(const fs::path& case_file) {
  check_diagnosis(case_file);
  DiagnosedCase{case_file};
}

/// A diagnosis' runs of each number are some dozens, those that confirm come in rounds of few.
constexpr int worth_in_a_diagnosis = 8;

}  // namespace

int models_at_once(JobVerb verb, const fs::path& case_file) {
  if (!makes_many_runs(verb)) return 1;
  return verb == JobVerb::identify ? parameters_of(case_file) + 1 : worth_in_a_diagnosis;
}

void check_case_for(JobVerb verb, const fs::path& case_file) {
  CommandLine command;
  command.case_file = case_file;
  command.quiet = true;
  check_case(command);
  if (verb == JobVerb::simulate) return;
  check_observations(command);
  const CaseFile file(case_file);
  if (verb == JobVerb::compare && !file.has("observations"))
    throw input_error("{}: observations: names nothing that was measured", case_file.string());
  if (verb == JobVerb::diagnose || verb == JobVerb::explain) check_diagnosed(case_file);
  if (verb == JobVerb::identify || (verb == JobVerb::explain && file.has("identification")))
    check_identification(command);
}

PlannedRuns planned_of(JobVerb verb, const fs::path& case_file, int processes) {
  PlannedRuns planned = planned_runs(verb, parameters_of(case_file));
  planned.processes = processes;
  planned.cores_of_model = cores_of_model(CaseFile(case_file));
  planned.model = measured(case_file);
  if (verb == JobVerb::diagnose || verb == JobVerb::explain) add_first_order(case_file, planned);
  return planned;
}

std::string plan_of(JobVerb verb, const CommandLine& command) {
  check_case_for(verb, command.case_file);
  const int room = std::max(1, usable_cores() / cores_of_model(CaseFile(command.case_file)));
  const int here = std::min(room, models_at_once(verb, command.case_file));
  PlannedRuns planned = planned_of(verb, command.case_file, command.processes > 0 ? command.processes : here);
  planned.cores = usable_cores();
  if (command.steps) planned.model.of_case = *command.steps;
  return plan_text(verb, planned);
}

}  // namespace tether
