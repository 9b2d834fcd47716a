#include <iostream>

#include "common/base/error.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/record_file.hpp"
#include "diagnosis/evidence/coarse_runs.hpp"
#include "diagnosis/evidence/living_runs.hpp"
#include "diagnosis/explanation/interruption.hpp"
#include "diagnosis/search/diagnosis_text.hpp"
#include "diagnosis/search/misfit_drawing.hpp"
#include "diagnosis/search/suggested_case.hpp"
#include "tether/diagnosed.hpp"
#include "tether/verbs.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// One run of each refined case, if the case wants them. cost: theirs is added.
std::vector<RefinedRun> refined_runs(const DiagnosedCase& given, const CommandLine& command, const fs::path& candidates,
                                     DiagnosisCost& cost) {
  std::vector<RefinedRun> all;
  if (!given.diagnosis.numerics) return all;
  for (RefinedCase& refined : write_refined(candidates, given)) {
    LivingRuns runs(command, refined.file, candidates.parent_path());
    FinishedMotion run = runs.make({{(refined.file.stem() / "runs/refined").string(), {}}}).front();
    cost.runs += runs.cost().runs;
    cost.runs_made += runs.cost().made;
    cost.cpu_seconds += runs.cost().cpu_seconds;
    if (!run.failed()) run = NodeMap(given.lumen, lumen_in(refined.file))(run);
    all.push_back({std::move(refined), std::move(run)});
  }
  return all;
}

/// Those of a coarser model, which show what each number does to first order; none where the case does not want it, or
/// the coarser model does not come to its end.
std::unique_ptr<ModelRuns> coarse_runs(const DiagnosedCase& given, const CommandLine& command,
                                       const fs::path& candidates) {
  if (!given.diagnosis.coarse) return nullptr;
  const fs::path file = write_coarse(candidates, given);
  auto runs = std::make_unique<CoarseRuns>(std::make_unique<LivingRuns>(command, file, candidates.parent_path()),
                                           given.lumen, lumen_in(file), file.stem().string());
  if (!runs->make({base_run()}).front().failed()) return runs;
  if (!command.quiet) std::cout << "The coarser model does not come to its end: all runs are of the model itself.\n";
  return nullptr;
}

std::string where_evidence_is(const fs::path& output, const Diagnosis& diagnosis,
                              const std::vector<std::string>& pictures) {
  std::string text = fmt::format(
      "{} runs, {} of them of a coarser model, {} made now, {:.0f} s of CPU\nIn {}:\n  diagnosis.json     every "
      "candidate, what these data "
      "would show, cost\n",
      diagnosis.cost.runs, diagnosis.cost.coarse_runs, diagnosis.cost.runs_made, diagnosis.cost.cpu_seconds,
      output.string());
  if (diagnosis.suggested_case)
    text += fmt::format("  suggested.yaml     the case with the effect: tether identify {}\n",
                        (output / *diagnosis.suggested_case).string());
  if (diagnosis.corrected_case)
    text += fmt::format("  corrected.yaml     the case with corrected data: tether explain {}\n",
                        (output / *diagnosis.corrected_case).string());
  for (const std::string& name : pictures) text += fmt::format("  plots/{}\n", name);
  return text;
}

/// What the case lacks, by runs of the programs: diagnosis.json, suggested.yaml, corrected.yaml in `output`, and
/// pictures.
Diagnosis diagnosed(const DiagnosedCase& given, const CommandLine& command, const fs::path& output,
                    const DiagnosisSettings& settings, std::vector<std::string>& pictures) {
  const fs::path candidates = output / "candidates.yaml";
  const std::vector<PlacedEffect> effects = catalogue_of(given.file, given.diagnosis);
  write_candidates(candidates, given.file, given.data, effects);
  DiagnosisCost of_refined;
  const std::vector<RefinedRun> refined = refined_runs(given, command, candidates, of_refined);
  LivingRuns runs(command, candidates, output);
  const auto coarse = coarse_runs(given, command, candidates);
  DiagnosisReport report = diagnose(given, effects, {runs, coarse.get(), refined}, settings);
  report.cost.runs += of_refined.runs;
  report.cost.runs_made += of_refined.runs_made;
  report.cost.cpu_seconds += of_refined.cpu_seconds;
  if (write_corrected(output / "corrected.yaml", given, report)) report.corrected = "corrected.yaml";
  if (write_suggested(output / "suggested.yaml", given, report, effects)) report.suggested = "suggested.yaml";
  Diagnosis diagnosis = diagnosis_of(report);
  write_record(output / "diagnosis.json", diagnosis);
  pictures = draw_ranking(diagnosis, output);
  for (std::string& name : draw_misfit(given.lumen, report, output)) pictures.push_back(std::move(name));
  return diagnosis;
}

}  // namespace

Made<Diagnosis> diagnose_further(const CommandLine& command, const DiagnosisSettings& settings) {
  check_case(command);
  const DiagnosedCase given(command.case_file);
  const fs::path output = fs::absolute(claim_output(command, given.file));
  fs::remove(output / "diagnosis.json");
  mark_output(output, command.case_file);
  std::vector<std::string> pictures;
  Diagnosis diagnosis = diagnosed(given, command, output, settings, pictures);
  std::string told = text_of(diagnosis) + where_evidence_is(output, diagnosis, pictures);
  return {std::move(diagnosis), std::move(told)};
}

Made<Diagnosis> diagnose(const CommandLine& command) {
  say_when_interrupted();
  return diagnose_further(command, {});
}

}  // namespace tether
