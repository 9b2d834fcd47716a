#include <iostream>

#include "common/base/error.hpp"
#include "common/base/interruption.hpp"
#include "common/base/session_folder.hpp"
#include "common/config/input_files.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/record_file.hpp"
#include "diagnosis/evidence/coarse_runs.hpp"
#include "diagnosis/evidence/growing_runs.hpp"
#include "diagnosis/evidence/living_runs.hpp"
#include "diagnosis/evidence/sensitivities.hpp"
#include "diagnosis/search/diagnosis_text.hpp"
#include "diagnosis/search/misfit_drawing.hpp"
#include "diagnosis/search/suggested_case.hpp"
#include "tether/diagnosed.hpp"
#include "tether/verbs.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// The case and its coarser one with all candidates, and what makes their runs.
class CandidateModels {
 public:
  CandidateModels(const DiagnosedCase& given, const CommandLine& command, fs::path output)
      : given_(given), command_(command), output_(std::move(output)) {}

  std::unique_ptr<ModelRuns> runs(const std::vector<PlacedEffect>& effects, int grown) const {
    return std::make_unique<LivingRuns>(command_, written(effects, grown), output_);
  }
  /// Of a coarser model, which show what each number does to first order; the first, asked for alone, guides the
  /// others: of a model that has grown that of the model as it is.
  std::unique_ptr<ModelRuns> coarse_runs(const std::vector<PlacedEffect>& effects, int grown) const {
    const fs::path file = write_coarse(written(effects, grown), given_);
    auto runs = std::make_unique<MappedRuns>(std::make_unique<LivingRuns>(command_, file, output_), given_.lumen,
                                             lumen_in(file), file.stem().string());
    if (grown > 0) runs->make({base_run()});
    return runs;
  }
  /// Of a finer model.
  std::unique_ptr<ModelRuns> refined_runs(const RefinedCase& refined) const {
    return std::make_unique<MappedRuns>(std::make_unique<LivingRuns>(command_, refined.file, output_), given_.lumen,
                                        lumen_in(refined.file), refined.file.stem().string());
  }
  /// The case with these candidates: candidates.yaml, and with more of them candidates_2.yaml, ...
  fs::path written(const std::vector<PlacedEffect>& effects, int grown) const {
    const fs::path file = output_ / (grown == 0 ? "candidates.yaml" : fmt::format("candidates_{}.yaml", grown + 1));
    write_candidates(file, given_.file, given_.data, effects);
    return file;
  }

 private:
  const DiagnosedCase& given_;
  const CommandLine& command_;
  fs::path output_;
};

/// Throws InputError if the programs refuse the case, or know no number that its diagnosis names.
void check_numbers(const DiagnosedCase& given, const ModelRuns& runs, const std::vector<PlacedEffect>& effects) {
  varied_numbers(runs.parameters(), effects, given.diagnosis, given.file);
}

/// Null where the case does not want a coarser model, or that does not come to its end.
std::unique_ptr<GrowingRuns> coarse_runs(const DiagnosedCase& given, const CandidateModels& models,
                                         const std::vector<PlacedEffect>& effects, bool quiet) {
  if (!given.diagnosis.coarse) return nullptr;
  auto runs = std::make_unique<GrowingRuns>(
      effects, [&models](const auto& all, int grown) { return models.coarse_runs(all, grown); });
  if (!runs->make({base_run()}).front().failed()) return runs;
  if (!quiet) std::cout << "The coarser model does not come to its end: all runs are of the model itself.\n";
  return nullptr;
}

/// One run of each refined case, if the case wants them. On a finer mesh more can be made, where no coarser one tells
/// what the mesh changes.
class RefinedModels {
 public:
  RefinedModels(const DiagnosedCase& given, const CandidateModels& models, const std::vector<PlacedEffect>& effects,
                bool has_coarse) {
    if (!given.asks_numerics()) return;
    const std::vector<RefinedCase> cases = write_refined(models.written(effects, 0), given);
    for (std::size_t k = 0; k < cases.size(); ++k) {
      runs_.push_back(std::make_unique<GrowingRuns>(effects, [&given, &models, k](const auto& all, int grown) {
        return models.refined_runs(write_refined(models.written(all, grown), given)[k]);
      }));
      FinishedMotion run = runs_.back()->make({base_run()}).front();
      const bool tells_effects = cases[k].changes_mesh && !(has_coarse && has_coarser_mesh(given.mesh));
      all_.push_back({cases[k], std::move(run), runs_.back().get(), tells_effects});
      runs_.back()->rest();
    }
  }
  void add(const std::vector<PlacedEffect>& more) {
    for (const auto& runs : runs_) runs->add(more);
  }
  const std::vector<RefinedRun>& all() const { return all_; }

 private:
  std::vector<std::unique_ptr<GrowingRuns>> runs_;
  std::vector<RefinedRun> all_;
};

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
  const std::vector<PlacedEffect> effects = catalogue_of(given.file, given.diagnosis);
  const CandidateModels models(given, command, output);
  GrowingRuns runs(effects, [&](const auto& all, int grown) { return models.runs(all, grown); });
  check_numbers(given, runs, effects);  // a case that is refused is refused before anything else runs
  given.inputs.check();                 // the groups have read it
  for (const char* old :
       {"diagnosis.json", "misfit.vtu", "misfit_patch.vtp", "plots/misfit.png", "plots/diagnosis.png"})
    fs::remove(output / old);  // nothing speaks against a new one any more
  mark_output(output, command.case_file);
  std::unique_ptr<GrowingRuns> coarse = coarse_runs(given, models, effects, command.quiet);
  RefinedModels refined(given, models, effects, coarse != nullptr);
  const auto extend = [&](const std::vector<PlacedEffect>& more) {
    runs.add(more);
    if (coarse) coarse->add(more);
    refined.add(more);
  };
  DiagnosisReport report = diagnose(given, effects, {runs, coarse.get(), refined.all(), extend}, settings);
  given.inputs.check();
  const auto is_made = [&](const char* name, auto write) {
    return make_to_go_on_with(output, name, [&](const fs::path& file) { write(file, given, report); });
  };
  if (is_made(corrected_file, write_corrected)) report.corrected = corrected_file;
  if (is_made(suggested_file, write_suggested)) report.suggested = suggested_file;
  Diagnosis diagnosis = diagnosis_of(report);
  diagnosis.data = data_hashes(command.case_file);
  write_record(output / "diagnosis.json", diagnosis);
  pictures = draw_ranking(diagnosis, output);
  for (std::string& name : draw_misfit(given.lumen, report, output)) pictures.push_back(std::move(name));
  return diagnosis;
}

}  // namespace

void check_numbers(const DiagnosedCase& given, const CommandLine& command) {
  const SessionFolder scratch("tether_numbers");
  const CandidateModels models(given, command, scratch.path());
  const std::vector<PlacedEffect> effects = catalogue_of(given.file, given.diagnosis);
  check_numbers(given, *models.runs(effects, 0), effects);
}

Made<Diagnosis> diagnose_further(const CommandLine& command, const DiagnosisSettings& settings) {
  check_case(command);
  const DiagnosedCase given(command.case_file);
  const fs::path output = fs::absolute(claim_output(command, given.file));
  check_replaceable(output, "diagnose", {suggested_file, corrected_file}, command.overwrite);
  std::vector<std::string> pictures;
  Diagnosis diagnosis = diagnosed(given, command, output, settings, pictures);
  std::string told = text_of(diagnosis) + where_evidence_is(output, diagnosis, pictures);
  return {std::move(diagnosis), std::move(told)};
}

Made<Diagnosis> diagnose(const CommandLine& command) {
  const WhenInterrupted way_on("the same command goes on from here");
  return diagnose_further(command, {});
}

}  // namespace tether
