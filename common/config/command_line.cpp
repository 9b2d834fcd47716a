#include "common/config/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>

#include "common/base/error.hpp"
#include "common/base/folder_lock.hpp"
#include "common/base/number_text.hpp"
#include "common/base/process.hpp"
#include "common/config/case.hpp"
#include "common/config/describe.hpp"
#include "common/config/describe_effects.hpp"

namespace tether {
namespace {

std::string reference(const Program& program, const std::string& format) {
  if (program.reference) return program.reference(format);
  if (format == "effects") {
    DescribeEffects effects(UnitSystem::cgs());
    program.declare(effects);
    return effects.markdown();
  }
  Describe describe(UnitSystem::cgs());
  CommonCase common;
  common.declare(describe);
  program.declare(describe);
  return format == "markdown" ? describe.markdown() : describe.text();
}

/// What was typed, and the format of --describe-config if that was asked.
struct Typed {
  CommandLine command;
  std::string describe_format;
};

/// "--steps: 0: must be a whole number, at least 1"
CLI::Validator whole_and_positive() {
  return {[](const std::string& text) {
            const bool fits = number_in<int>(text).value_or(0) >= 1;
            return fits ? std::string() : text + ": must be a whole number, at least 1";
          },
          "", "whole and positive"};
}

void add_reference(CLI::App& app, Typed& typed) {
  app.add_option("--describe-config", typed.describe_format,
                 "list every field of the case file that this program reads")
      ->expected(0, 1)
      ->default_str("text")
      ->type_name("[text|markdown|effects]")
      ->check(CLI::IsMember({"text", "markdown", "effects"}));
}

void add_options(CLI::App& app, const Program& program, Typed& typed) {
  add_reference(app, typed);
  if (!program.argument) return;
  CommandLine& c = typed.command;
  app.add_option(program.argument->name, c.case_file, program.argument->meaning)->type_name("");
  app.footer(program.argument->otherwise);
  app.add_flag("--validate", c.validate, "check the case and all it refers to, then end");
  if (program.plan)
    app.add_flag("--plan", c.plan, "tell how many runs, how much memory and time it would take, then end");
  if (program.list_effects)
    app.add_flag("--list-effects", c.list_effects, "list what could be added to the case, as JSON");
  app.add_option("--output", c.output, "folder for the results (default out/NAME)")->type_name("DIR");
  if (program.makes_steps) {
    app.add_option("--steps", c.steps, "end after N time steps")->type_name("N")->check(whole_and_positive());
    app.add_flag("--resume", c.resume, "continue from the last checkpoint in the output folder");
  }
  if (program.shares_work)
    app.add_option("--processes", c.processes, "groups of processes to share the work between")
        ->type_name("N")
        ->check(whole_and_positive());
  if (program.shares_runs)
    app.add_option("--runs", c.runs, "folder of runs that several data sets of one model share")->type_name("DIR");
  if (!program.roles.empty()) {
    c.role = program.roles.front();
    app.add_option("--role", c.role, "what it is to its master (default " + c.role + ")")
        ->check(CLI::IsMember(program.roles));
  }
  app.add_flag("--overwrite", c.overwrite, "replace another case's results in the output folder");
  app.add_flag("--quiet", c.quiet, "print errors only");
}

int act(const Program& program, const Typed& typed) {
  if (!typed.describe_format.empty()) {
    std::cout << reference(program, typed.describe_format);
    return exit_done;
  }
  if (program.argument && typed.command.case_file.empty())
    throw input_error("{} is missing: {}; --help tells more", program.argument->name, program.argument->meaning);
  if (typed.command.list_effects) {
    std::cout << program.list_effects(typed.command) << "\n";
    return exit_done;
  }
  if (typed.command.plan) {
    std::cout << program.plan(typed.command);
    return exit_done;
  }
  if (!typed.command.validate) return program.run(typed.command);
  program.validate(typed.command);
  if (!typed.command.quiet) std::cout << typed.command.case_file.string() << ": valid for " << program.name << "\n";
  return exit_done;
}

/// What the person named, or may do, and not what the machine is short of.
bool is_of_input(const std::error_code& code) {
  constexpr std::array named{std::errc::permission_denied,    std::errc::operation_not_permitted,
                             std::errc::not_a_directory,      std::errc::is_a_directory,
                             std::errc::filename_too_long,    std::errc::too_many_symbolic_link_levels,
                             std::errc::read_only_file_system};
  return std::any_of(named.begin(), named.end(), [&](std::errc one) { return code == one; });
}

}  // namespace

int guarded(const std::string& program, const std::function<int()>& body) {
  try {
    try {
      return body();
    } catch (const InputError&) {
      check_all_held();  // what is missing in a folder that is gone is no mistake of the user's
      throw;
    }
  } catch (const InputError& error) {
    std::cerr << error.what() << std::endl;
    return exit_input_wrong;
  } catch (const ToldFailure& failure) {
    return failure.exit_code;
  } catch (const std::filesystem::filesystem_error& error) {
    std::cerr << fmt::format("{}: {}", error.path1().string(), error.code().message()) << std::endl;
    return is_of_input(error.code()) ? exit_input_wrong : exit_run_failed;
  } catch (const std::exception& error) {
    std::cerr << program << ": " << error.what() << std::endl;
    return exit_run_failed;
  }
}

int run_main(int argc, char** argv, const Program& program) {
  prepare_process();
  Typed typed;
  CLI::App app(program.purpose, program.name);
  add_options(app, program, typed);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? exit_done : exit_input_wrong;
  }
  const CLI::Option* output = app.get_option_no_throw("--output");
  if (output != nullptr && output->count() > 0 && typed.command.output.empty()) {
    std::cerr << "--output: '': must name a folder" << std::endl;  // a script's variable without a value
    return exit_input_wrong;
  }
  if (typed.command.output.string().starts_with('-'))  // programs that it is handed to would take it for an option
    typed.command.output = "." / typed.command.output;
  return guarded(program.name, [&] { return act(program, typed); });
}

}  // namespace tether
