#include "tether/programs.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <iostream>

#include "common/base/error.hpp"

namespace tether {
namespace {

void add_options(std::vector<std::string>& words, const CommandLine& command) {
  if (!command.output.empty()) words.insert(words.end(), {"--output", command.output.string()});
  if (command.steps) words.insert(words.end(), {"--steps", std::to_string(*command.steps)});
  if (command.processes > 0) words.insert(words.end(), {"--processes", std::to_string(command.processes)});
  if (command.resume) words.push_back("--resume");
  if (command.overwrite) words.push_back("--overwrite");
  if (command.quiet) words.push_back("--quiet");
}

/// mpirun gives its processes a terminal of its own: whether a person looks at ours, and how wide it is, is ours to
/// say.
void add_terminal(std::vector<std::pair<std::string, std::string>>& environment) {
  const bool terminal = isatty(STDOUT_FILENO) == 1;
  environment.emplace_back("TETHER_PROGRESS", terminal ? "bar" : "lines");
  winsize size{};
  if (terminal && ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
    environment.emplace_back("COLUMNS", std::to_string(size.ws_col));
}

}  // namespace

std::filesystem::path sibling(const std::string& name) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
  if (access(program.c_str(), X_OK) != 0) throw input_error("{}: no such program; is Tether built?", program.string());
  return program;
}

Command parallel_run(const std::string& master, const CommandLine& command) {
  Command run{{"mpirun", "--quiet", "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1", "-n",
               "1", sibling(master).string(), command.case_file.string()},
              {}};
  add_options(run.words, command);
  add_terminal(run.environment);
  if (geteuid() == 0) {
    run.environment.emplace_back("OMPI_ALLOW_RUN_AS_ROOT", "1");
    run.environment.emplace_back("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
  }
  return run;
}

int report_failure(int code, const std::string& master, const char* verb, const CommandLine& command) {
  if (code > 128)
    std::cerr << fmt::format(
        "tether: {} was ended by signal {}{}; the last checkpoint is kept: tether {} {} --resume\n", master, code - 128,
        code == 128 + 9 ? " (killed; out of memory?)" : "", verb, command.case_file.string());
  return code == exit_input_wrong ? code : exit_run_failed;
}

}  // namespace tether
