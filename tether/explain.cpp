#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>

#include "common/base/error.hpp"
#include "common/base/interruption.hpp"
#include "common/config/input_files.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/record_file.hpp"
#include "diagnosis/explanation/explainer.hpp"
#include "identification_master/results/estimate.hpp"
#include "report/report.hpp"
#include "tether/diagnosed.hpp"
#include "tether/verbs.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// The other verbs do what an explanation needs.
class Verbs : public ExplanationWork {
 public:
  explicit Verbs(const CommandLine& command) : command_(command) {}
  void compare(const ExplanationTask& task) override { make<ComparisonResult>(tether::compare, task); }
  void diagnose(const ExplanationTask& task, const DiagnosisSettings& settings) override {
    const CommandLine command = command_for(task);
    print(diagnose_further(command, settings), command);
  }
  void identify(const ExplanationTask& task) override { make<Estimate>(tether::identify, task); }

 private:
  template <class Result>
  void make(VerbWith<Result> verb, const ExplanationTask& task) const {
    const CommandLine command = command_for(task);
    print(verb(command), command);
  }
  CommandLine command_for(const ExplanationTask& task) const {
    CommandLine command = command_;
    command.case_file = task.case_file;
    command.output = task.folder;
    command.overwrite = true;
    command.resume = task.resume && !command_.overwrite;
    return command;
  }

  const CommandLine& command_;
};

std::string line_of(const ExplainedModel& model, double millimetres) {
  const auto text = [&](const std::optional<Misfit>& misfit) {
    return misfit ? fmt::format("{:.2f} ({:.1f})", millimetres * misfit->length, misfit->in_noise) : std::string("-");
  };
  return fmt::format("  {:<48} {:>12} {:>12}{}\n", fmt::format("{} {}", model.number, model.name), text(model.training),
                     text(model.held_out), model.accepted ? "" : "  not kept");
}

std::string text_of(const Explanation& explanation, double millimetres, const fs::path& output) {
  std::string text = "\n";
  for (const std::string& sentence : explanation.sentences) text += sentence + "\n";
  text += fmt::format("\n  {:<48} {:>12} {:>12}\n", "model: distance in mm (in the noise)", "training", "held out");
  for (const ExplainedModel& model : explanation.models) text += line_of(model, millimetres);
  text += fmt::format("\nIn {}:\n  explain.json       the whole path\n", output.string());
  if (explanation.suggested_case)
    text += fmt::format("  {}       the case with what was found, ready for tether simulate\n",
                        *explanation.suggested_case);
  if (explanation.corrected_case)
    text += fmt::format("  {}   the case with corrected data: tether explain {}\n", *explanation.corrected_case,
                        (output / *explanation.corrected_case).string());
  return text;
}

/// model_0.yaml, ...: the last one is to go on with.
std::vector<fs::path> models_in(const fs::path& output) {
  const std::regex model("model_[0-9]+\\.yaml");
  std::vector<fs::path> models;
  for (const auto& entry : fs::directory_iterator(output))
    if (std::regex_match(entry.path().filename().string(), model)) models.push_back(entry.path().filename());
  std::sort(models.begin(), models.end());
  return models;
}

/// What identifications and diagnoses on the way made for a person to go on with.
void check_steps_unchanged(const fs::path& output) {
  const std::regex step("(identification|diagnosis)_[0-9]+|force");
  for (const auto& entry : fs::directory_iterator(output)) {
    std::smatch found;
    const std::string name = entry.path().filename().string();
    if (!entry.is_directory() || !std::regex_match(name, found, step)) continue;
    if (found[1] != "identification")
      check_unchanged(entry.path(), "diagnose", {suggested_file, corrected_file});
    else
      check_unchanged(entry.path(), "identify", {identified_file});
  }
}

/// Takes an earlier explanation away, unless this one would be refused: before its first run, since its diagnoses come
/// late.
void replace_old(const DiagnosedCase& given, const CommandLine& command, const fs::path& output) {
  const std::array<fs::path, 2> old{output / "explain.json", output / "report.html"};
  const bool is_new = std::none_of(old.begin(), old.end(), [](const fs::path& file) { return fs::exists(file); });
  if (is_new && fs::exists(output / "model_0/summary.json")) return;  // checked when it began
  check_numbers(given, command);
  given.inputs.check();
  for (const fs::path& file : old) fs::remove(file);
}

}  // namespace

Made<Explanation> explain(const CommandLine& command) {
  const WhenInterrupted way_on("the same command goes on from here");
  check_case(command);
  const DiagnosedCase given(command.case_file);
  CommandLine own = command;
  if (own.output.empty()) own.output = fs::path("out") / (given.file.common().name + "_explain");
  const fs::path output = fs::absolute(claim_output(own, given.file));
  check_replaceable(output, "explain", models_in(output), own.overwrite);
  if (!own.overwrite) check_steps_unchanged(output);
  replace_old(given, own, output);
  mark_output(output, command.case_file);
  Verbs verbs(own);
  const ExplanationPath path = explain(given, output, verbs, own.quiet);
  given.inputs.check();
  Explanation explanation = explanation_of(path);
  explanation.data = data_hashes(command.case_file);
  write_record(output / "explain.json", explanation);
  const fs::path page = write_report(output);
  std::string told = text_of(explanation, path.millimetres, own.output) +
                     "  report.html        all of it, to look at and to mail: " + page.string() + "\n";
  return {std::move(explanation), std::move(told)};
}

}  // namespace tether
