#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "common/config/fields.hpp"

namespace tether {

/// What the user typed: the same words for every program.
struct CommandLine {
  std::filesystem::path case_file;
  std::filesystem::path output;  ///< empty: out/NAME of the case
  std::optional<int> steps;      ///< stop after that many, whatever the case says
  std::string role;              ///< one of the program's roles; empty if it has but one
  int processes = 0;             ///< to share the work between; 0: the program decides
  std::filesystem::path runs;    ///< a folder of runs that several data sets share; empty: none
  bool validate = false, plan = false, list_effects = false, resume = false, overwrite = false, quiet = false;
};

/// What a program works on, as its help tells it.
struct Argument {
  const char *name = "CASE.yaml", *meaning = "the case file";
  const char* otherwise = "";  ///< another way to call the program, told below the options
};

/// A program as its main presents it.
struct Program {
  std::string name = {}, purpose = {};
  /// Declares the sections of the case file that this program reads, beside the common ones.
  std::function<void(Fields&)> declare = {};
  /// For --describe-config, instead of `declare`, if set: the whole reference as "text" or "markdown".
  std::function<std::string(const std::string& format)> reference = {};
  /// For --validate: reads the case and what it refers to. Throws InputError.
  std::function<void(const CommandLine&)> validate = {};
  /// For --plan, an option only where this is set: what running would take, for a person.
  std::function<std::string(const CommandLine&)> plan = {};
  /// For --list-effects, an option only where this is set: what could be added to the case, as JSON.
  std::function<std::string(const CommandLine&)> list_effects = {};
  /// Returns the exit code.
  std::function<int(const CommandLine&)> run = {};
  /// What it may be, the first by default, if there is a choice: --role.
  std::vector<std::string> roles = {};
  /// Nothing where it only tells of itself: it has no options for results either.
  std::optional<Argument> argument = Argument{};
  bool shares_work = false;  ///< has the option --processes
  bool shares_runs = false;  ///< has the option --runs
  bool makes_steps = true;   ///< has the options --steps and --resume
};

/// Parses the command line, answers --help, --describe-config and --validate, else runs. Returns the exit code: what
/// the program throws becomes one message on stderr and 2 (the input is wrong) or 1 (the run failed).
int run_main(int argc, char** argv, const Program& program);

/// Runs `body` under the same rule for messages and exit codes.
int guarded(const std::string& program, const std::function<int()>& body);

}  // namespace tether
