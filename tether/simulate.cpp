#include <algorithm>
#include <array>
#include <csignal>
#include <iostream>
#include <set>

#include "common/base/error.hpp"
#include "common/base/interruption.hpp"
#include "common/base/name.hpp"
#include "common/config/case_file.hpp"
#include "common/config/case_tree.hpp"
#include "common/config/output_folder.hpp"
#include "common/io/record_file.hpp"
#include "common/protocol/programs.hpp"
#include "diagnosis/comparison/finished_run.hpp"
#include "diagnosis/evidence/candidates.hpp"
#include "pictures/pictures.hpp"
#include "pictures/plots.hpp"
#include "tether/summary.hpp"
#include "tether/verbs.hpp"

namespace tether {
namespace {

void announce(const CaseFile& file, int steps, const std::filesystem::path& output) {
  const auto& common = file.common();
  std::cout << fmt::format("{}: {}\n{} steps of {} s, results in {}\n", common.name, common.title, steps,
                           common.time.step, output.string())
            << std::flush;
}

/// What a program has to say against the case. Throws InputError or RunError with its message.
void check_with(const char* program, const CommandLine& command) {
  const ChildEnd end = capture({{sibling(program).string(), "--validate", "--quiet", command.case_file.string()}, {}});
  const std::string message = end.errors.substr(0, end.errors.find_last_not_of('\n') + 1);
  if (end.exit_code == exit_input_wrong) throw InputError(message);
  constexpr std::array crashes{SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL};
  const bool has_crashed = std::find(crashes.begin(), crashes.end(), end.exit_code - 128) != crashes.end();
  if (end.exit_code > 128)
    throw run_error("{}{}{} {} while it read {}{}", message, message.empty() ? "" : "\n", program,
                    how_it_ended(end.exit_code), command.case_file.string(),
                    has_crashed ? ": one of the files that the case names is damaged?" : "");
  if (end.exit_code != exit_done)
    throw RunError(message.empty() ? fmt::format("{} {} and without a word", program, how_it_ended(end.exit_code))
                                   : message);
}

/// What a case says, without what a terminal would obey.
std::string shown_in_one_line(const std::string& text) {
  std::string line = printable(text);
  std::replace(line.begin(), line.end(), '\n', '?');
  return line;
}

/// A case may be somebody else's: the programs that it names are shown before they run, each once.
void show_programs(const std::filesystem::path& case_file) {
  static std::set<std::string> shown;
  const YamlNode tree = read_case_tree(case_file);
  const YamlNode* coupling = tree.find("coupling");
  const YamlNode* programs = coupling == nullptr ? nullptr : coupling->find("programs");
  if (programs == nullptr) return;
  for (const YamlNode::Entry& entry : programs->entries)
    if (shown.insert(entry.key + "|" + entry.value.text).second)
      fmt::print(stderr, "{}: this case runs {} as its {}\n", entry.place.text(), shown_in_one_line(entry.value.text),
                 shown_in_one_line(entry.key));
}

void tell_of_longer_run(const CommandLine& command, const std::filesystem::path& output) {
  const auto made = read_record<RunSummary>(output / "summary.json").steps;
  if (command.steps && made > *command.steps)
    std::cerr << fmt::format("--steps {}: the run in {} has {} steps, which are all compared\n", *command.steps,
                             output.string(), made);
}

}  // namespace

void check_case(const CommandLine& command) {
  if (!std::filesystem::exists(command.case_file)) throw input_error("{}: no such file", command.case_file.string());
  check_with("fsi_master", command);
  show_programs(command.case_file);
}

void check_observations(const CommandLine& command) {
  check_with("observation_manager", command);
}

void check_identification(const CommandLine& command) {
  check_with("identification_master", command);
}

int validate(const CommandLine& command) {
  check_case(command);
  check_observations(command);
  if (CaseFile(command.case_file).has("identification")) check_identification(command);
  check_twin(command);
  check_diagnosis(command.case_file);
  if (!command.quiet) std::cout << command.case_file.string() << ": valid\n";
  return exit_done;
}

Made<RunSummary> simulate(const CommandLine& command) {
  check_case(command);
  const CaseFile file(command.case_file);
  const auto output = claim_output(command, file);
  if (!command.quiet) announce(file, command.steps.value_or(file.common().time.steps()), output);
  CommandLine one = command;
  one.processes = 0;  // how many runs at once is no matter of one
  run_to_end("fsi_master", "simulate", one);
  const WhenInterrupted way_on("the run has come to its end; with --resume the same command draws its plots");
  auto plots = draw_plots(output, file.units(), file.common().image.pressure);
  const auto pictures = draw_pictures(output, file.units());
  plots.insert(plots.begin(), pictures.begin(), pictures.end());
  auto summary = read_record<RunSummary>(output / "summary.json");
  std::string told = text_of(summary) + where_to_look(output, plots);
  return {std::move(summary), std::move(told)};
}

void provide_run(const CommandLine& command, const CaseFile& file, const std::filesystem::path& output,
                 const Points& measured_at) {
  const bool is_there = std::filesystem::exists(output / "summary.json");
  if (const auto damage = is_there ? damage_of(output) : std::nullopt) {
    std::cerr << *damage << ": the run is made again\n";
    return print(simulate(command), command);
  }
  auto why = why_not_run(output, file, command.steps.value_or(file.common().time.steps()));
  if (!why) why = why_no_velocity(output, measured_at);
  if (!why) return tell_of_longer_run(command, output);
  if (!command.quiet) std::cout << *why << ": simulating first\n" << std::flush;
  print(simulate(command), command);
}

}  // namespace tether
