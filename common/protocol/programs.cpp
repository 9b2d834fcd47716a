#include "common/protocol/programs.hpp"

#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "common/base/circumstances.hpp"
#include "common/base/end_request.hpp"
#include "common/base/error.hpp"
#include "common/base/folder_lock.hpp"
#include "common/base/interruption.hpp"
#include "common/base/limits.hpp"
#include "common/base/newest_state.hpp"
#include "common/base/process.hpp"
#include "common/base/session_folder.hpp"
#include "common/base/shell_quoted.hpp"
#include "common/base/temporary_folder.hpp"
#include "common/base/way_on.hpp"
#include "common/config/case_file.hpp"
#include "common/config/output_folder.hpp"
#include "common/protocol/nodes.hpp"
#include "common/protocol/told.hpp"

namespace tether {
namespace {

/// mpirun takes a colon alone for the next program.
std::string path_for_mpirun(const std::filesystem::path& path) {
  return path == ":" ? "./:" : path.string();
}

void add_options(std::vector<std::string>& words, const CommandLine& command) {
  if (!command.output.empty()) words.insert(words.end(), {"--output", path_for_mpirun(command.output)});
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

/// Whether Open MPI knows by itself which nodes there are: from a scheduler, or from a file of the user's.
bool are_nodes_given() {
  constexpr std::array by = {"SLURM_JOB_ID", "PBS_JOBID", "LSB_JOBID", "JOB_ID", "OMPI_MCA_orte_default_hostfile"};
  return std::any_of(by.begin(), by.end(), [](const char* name) { return std::getenv(name) != nullptr; });
}

/// The nodes, which mpirun reaches by ssh where no scheduler gave them; and that one of which nothing is heard for half
/// a minute is lost: Open MPI would wait for eight, and ssh without end. The user's own settings stand. Throws
/// InputError if the first is another machine: locks and notes of the run are looked for here.
void add_nodes(Command& run) {
  const std::vector<std::string> nodes = protocol::nodes_of_job();
  if (nodes.empty()) return;
  const auto set = [&run](const char* name, const char* value) {
    if (std::getenv(name) == nullptr) run.environment.emplace_back(name, value);
  };
  if (!are_nodes_given()) {
    if (!protocol::is_here(nodes.front()))
      throw input_error("{}: {} is not this machine ({}), which must be the first", protocol::nodes_variable,
                        nodes.front(), host_name());
    run.words.insert(run.words.begin() + 1, {"--host", fmt::to_string(fmt::join(nodes, ","))});
    const char* agent = std::getenv("OMPI_MCA_plm_rsh_agent");
    if (agent == nullptr || std::string_view(agent).starts_with("ssh"))
      set("OMPI_MCA_plm_rsh_args", "-o ServerAliveInterval=10 -o ServerAliveCountMax=2 -o ConnectTimeout=30");
  }
  set("OMPI_MCA_oob_tcp_keepalive_time", "10");
  set("OMPI_MCA_oob_tcp_keepalive_intvl", "5");
  set("OMPI_MCA_oob_tcp_keepalive_probes", "4");
}

/// The file by which a run's programs let this process know that they said why they failed; gone with this process.
class NoteOfFailure {
 public:
  NoteOfFailure() { take(); }
  ~NoteOfFailure() { take(); }
  NoteOfFailure(const NoteOfFailure&) = delete;
  NoteOfFailure& operator=(const NoteOfFailure&) = delete;
  std::string path() const { return path_.string(); }
  protocol::Told take() { return protocol::take_note(path_); }

 private:
  std::filesystem::path path_ = temporary_folder() / fmt::format("tether_told_{}_{}", host_name(), getpid());
};

NoteOfFailure& note_of_failure() {
  static NoteOfFailure note;
  return note;
}

/// [MB] of what Open MPI keeps in TMPDIR: below 28 a simulation did not begin, below 96 an identification of two
/// models; 24 and 64 were too little (decision 118).
double session_size(const std::string& master) {
  return master == "fsi_master" ? 28 : 96;
}

/// Where Open MPI keeps its files of a run on this machine: gone with this process, or with the next one after it was
/// killed, while an mpirun that is killed leaves up to 110 MB in TMPDIR. The user's own place stands.
void add_session_folder(Command& run) {
  constexpr const char* variable = "OMPI_MCA_orte_tmpdir_base";
  if (std::getenv(variable) != nullptr || !protocol::nodes_of_job().empty()) return;
  static const SessionFolder folder("tether_mpi");
  run.environment.emplace_back(variable, folder.path().string());
}

/// The folder of the results; nothing where the case, which says it, cannot be read any more.
std::filesystem::path known_output(const CommandLine& command) {
  try {
    return command.output.empty() ? output_of(command, CaseFile(command.case_file)) : command.output;
  } catch (const InputError&) {
    return {};
  }
}

/// As a shell takes it for one word.
std::string as_word(const std::string& text) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/._-+=:,@%";
  if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
  return shell_quoted(text);
}

/// How to go on from the last state that the master saved; nothing if there is none, or if the verb that runs it says
/// how.
std::string way_on(const std::string& master, const char* verb, const CommandLine& command) {
  const std::filesystem::path output = known_output(command);
  if (output.empty() || WhenInterrupted::is_told()) return {};
  if (!has_state(output, master == "fsi_master" ? StateOf::run : StateOf::identification)) return {};
  CommandLine resumed = command;
  resumed.output = output;
  resumed.resume = true;
  resumed.overwrite = resumed.quiet = false;
  std::vector<std::string> words{"tether", verb, command.case_file.string()};
  add_options(words, resumed);
  for (std::string& word : words) word = as_word(word);
  return fmt::format("{}{}\n", to_continue, fmt::join(words, " "));
}

/// The nodes of the job that do not answer any more, "h1, h2"; nothing if all do.
std::string lost_nodes() {
  constexpr double patience = 5;  // [s]
  return fmt::to_string(fmt::join(protocol::silent_nodes(protocol::nodes_of_job(), patience), ", "));
}

/// Whether what this process writes is lost: its reader has left (`| head`).
bool is_output_closed() {
  pollfd output{STDOUT_FILENO, POLLOUT, 0};
  return poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

/// What the environment sets of Open MPI, "; the environment sets OMPI_MCA_btl ...": with some values it does not
/// begin, and says little or nothing of it.
std::string settings_of_mpi() {
  std::vector<std::string> names;
  for (char** entry = environ; *entry != nullptr; ++entry)
    if (const std::string_view text = *entry; text.starts_with("OMPI_MCA_") || text.starts_with("PMIX_MCA_"))
      names.emplace_back(text.substr(0, text.find('=')));
  if (names.empty()) return {};
  return fmt::format("; the environment sets {} for Open MPI, which does not begin with each value",
                     fmt::join(names, ", "));
}

/// Of a run of which no program said a word. Beyond the signals stand mpirun's own numbers.
std::string how_it_failed(const ForegroundEnd& end, const std::string& master) {
  if (end.exit_code >= 128 + NSIG)
    return fmt::format("mpirun broke off ({}): a node of the job was lost, or the job was ended from outside",
                       end.exit_code);
  // mpirun ends with the number of the process that died, and does not say which of the run it was.
  const std::string who = end.was_killed ? "mpirun" : master + " or a process that it started";
  const std::string how = fmt::format("{} {}", who, how_it_ended(end.exit_code));
  if (is_output_closed()) return "nobody reads what the run says any more (a pipe whose reader has ended)";
  if (end.exit_code == 128 + SIGKILL) return how + ": out of memory?";
  return (end.exit_code > 128 ? how : how + " and without a word: was mpirun interrupted?") + settings_of_mpi();
}

}  // namespace

std::filesystem::path sibling(const std::string& name) {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
  if (access(program.c_str(), X_OK) != 0) throw input_error("{}: no such program; is Tether built?", program.string());
  return program;
}

Command parallel_run(const std::string& master, const CommandLine& command) {
  check_circumstances(session_size(master));
  check_limits();
  Command run{{"mpirun", "--quiet", "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1", "-n",
               "1", sibling(master).string(), path_for_mpirun(command.case_file)},
              {}};
  add_options(run.words, command);
  add_nodes(run);
  add_session_folder(run);
  add_terminal(run.environment);
  note_of_failure().take();
  run.environment.emplace_back("TMPDIR", temporary_folder().string());
  run.environment.emplace_back(protocol::told_variable, note_of_failure().path());
  run.environment.emplace_back(holder_variable, holder_name());
  run.environment.emplace_back("EVENT_NOEPOLL", "1");  // Open MPI's libevent warns of descriptors closed too early
  if (geteuid() == 0) {
    run.environment.emplace_back("OMPI_ALLOW_RUN_AS_ROOT", "1");
    run.environment.emplace_back("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
  }
  return run;
}

int report_failure(const ForegroundEnd& end, const std::string& master, const char* verb, const CommandLine& command) {
  const protocol::Told told = note_of_failure().take();
  if (end.handed_on != 0 && told != protocol::Told::interruption)
    std::cerr << "tether: interrupted\n";
  else if (const std::string lost = end.handed_on == 0 ? lost_nodes() : ""; !lost.empty())
    std::cerr << fmt::format("tether: mpirun ended the run: no answer from {}\n", lost);
  else if (told == protocol::Told::nothing && !end.was_still)
    std::cerr << fmt::format("tether: {}\n", how_it_failed(end, master));
  if (end.exit_code == exit_input_wrong) return exit_input_wrong;
  std::cerr << way_on(master, verb, command);
  return exit_run_failed;
}

void run_to_end(const std::string& master, const char* verb, const CommandLine& command) {
  if (end_is_requested()) throw run_error("{}", told_to_end);
  const ForegroundEnd end = run_in_foreground(parallel_run(master, command));
  if (end.exit_code != exit_done) throw ToldFailure(report_failure(end, master, verb, command));
  if (end.handed_on != 0) std::raise(end.handed_on);  // too late for the run, not for what follows
}

}  // namespace tether
