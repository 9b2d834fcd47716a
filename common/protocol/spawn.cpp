#include "common/protocol/spawn.hpp"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/base/limits.hpp"
#include "common/base/process.hpp"
#include "common/base/temporary_folder.hpp"
#include "common/protocol/guard.hpp"
#include "common/protocol/job.hpp"
#include "common/protocol/nodes.hpp"
#include "common/protocol/signals.hpp"
#include "common/protocol/stillness.hpp"
#include "common/protocol/told.hpp"
#include "common/protocol/watch.hpp"

namespace tether::protocol {

namespace {

/// What a shell, which then becomes the program, does first: it leaves its pid and host, so that the death of a program
/// that never reaches MPI_Init can be noticed. `$0`: the file, `$@`: the program and its arguments.
constexpr const char* starter = "echo $$ $(uname -n) >>\"$0\"; exec \"$@\"";

/// The file for that, removed with this object. Its folder may be one that several hosts share.
class PidFile {
 public:
  PidFile() : path_(temporary_folder() / fmt::format("tether-{}-{}-{}", host_name(), process_id(), ++count_)) {
    remove();
  }
  ~PidFile() { remove(); }
  PidFile(const PidFile&) = delete;
  PidFile& operator=(const PidFile&) = delete;
  std::string path() const { return path_.string(); }
  void remove() const {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  /// 0 before it is written, and for ever if the process is on another host.
  std::int64_t pid() const {
    std::int64_t pid = 0;
    std::string host;
    std::ifstream(path_) >> pid >> host;
    return host == host_name() ? pid : 0;
  }

 private:
  std::filesystem::path path_;
  static inline int count_ = 0;
};

/// MPI_Comm_spawn neither ends nor fails if the program never reaches MPI_Init: this ends the job instead.
class SpawnCheck {
 public:
  SpawnCheck(const PidFile& file, const std::string& role, const std::string& executable, std::string master_role)
      : file_(file),
        role_(role.empty() ? executable : role),
        program_(role_ == executable ? executable : fmt::format("{} ({})", role_, executable)),
        master_role_(std::move(master_role)) {}

  void operator()(double seconds) {
    const std::int64_t pid = file_.pid();
    if (pid != 0 && !is_running(pid)) fail(program_ + " ended before it reached MPI");
    if (interrupted()) fail("interrupted before " + program_ + " reached MPI");
    if (pid != 0) check_stopped({role_, host_name(), pid, "starting"});
    if (seconds > start_limit() && stillness_.stopped() == 0)
      fail(fmt::format("{} did not reach MPI within {} s", program_, start_limit()));
  }

 private:
  void check_stopped(const Peer& peer) {
    stillness_.look(peer);
    if (stillness_.stopped() > stopped_limit()) fail(PeerStopped(peer, stopped_limit()).what());
    if (stillness_.stopped() < tell_stopped_after || is_told_) return;
    is_told_ = true;
    fmt::print(stderr, "{}: {}\n", master_role_, stopped_text(peer));
  }
  [[noreturn]] void fail(const std::string& message) const {
    file_.remove();
    give_up(master_role_, message);
  }

  const PidFile& file_;
  std::string role_, program_, master_role_;
  Stillness stillness_;
  bool is_told_ = false;
};

/// Unless the user said otherwise: more processes than cores, none bound to one, no pages of mpirun's own about a
/// process that died, and no segments of shared memory, which would stay behind it.
void prepare_open_mpi() {
  setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 0);
  setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
  setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 0);
  setenv("OMPI_MCA_orte_execute_quiet", "1", 0);
  setenv("OMPI_MCA_btl", "self,tcp", 0);
}

/// What the environment says of a start: read before MPI_Init, which changes it while the guard's thread runs.
struct Start {
  Peer master = marking_master();
  bool is_first = std::string_view(rank()) == "0";
  double limit = start_limit();

 private:
  static const char* rank() {
    const char* text = std::getenv("OMPI_COMM_WORLD_RANK");
    return text == nullptr ? "0" : text;
  }
};

/// MPI_Init of an MPMD line waits for all its programs. Only the first of them tells that it is in vain. A spawned
/// program whose master has died meanwhile, or is told to end, goes silently.
void check_initialising(double seconds, const std::string& role, const Start& start) {
  if (is_dead(start.master) || (start.master.pid != 0 && interrupted())) end_job(exit_run_failed);
  if (start.is_first && interrupted())
    give_up(role, "interrupted while MPI started: a program of the mpirun line ended");
  if (start.is_first && seconds > start.limit)
    give_up(role,
            fmt::format("MPI did not start within {} s: a program of the mpirun line did not reach it", start.limit));
  if (seconds > start.limit + 2) end_job(exit_run_failed);
}

/// "env NAME=VALUE ...": the variables of Tether's own and of OpenBLAS, whose kernels decide the last digits, for a
/// program on another node, where nobody set them, and which node that is. Not in MPI_Info: its values end after 255
/// characters.
std::vector<std::string> told_on(const std::string& node) {
  std::vector<std::string> words{"env"};
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text = *entry, name = text.substr(0, text.find('='));
    const bool is_ours = name.starts_with("TETHER_") && name != master_variable && name != node_variable;
    if (is_ours || name.starts_with("OPENBLAS_")) words.emplace_back(text);
  }
  words.push_back(fmt::format("{}={}", node_variable, node));
  return words;
}

MPI_Info spawn_info(const std::string& node) {
  MPI_Info info = MPI_INFO_NULL;
  MPI_Info_create(&info);
  MPI_Info_set(info, "wdir", std::filesystem::current_path().c_str());
  MPI_Info_set(info, "env", mark_of_children().c_str());
  if (!node.empty()) MPI_Info_set(info, "host", node.c_str());
  return info;
}

}  // namespace

void check_mpi(int code, const char* what) {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING] = {};
  int length = 0;
  MPI_Error_string(code, text, &length);
  throw run_error("{}: {}", what, text);
}

int rank_in(MPI_Comm communicator) {
  int rank = 0;
  check_mpi(MPI_Comm_rank(communicator, &rank), "MPI_Comm_rank");
  return rank;
}

int size_of(MPI_Comm communicator) {
  int size = 0;
  check_mpi(MPI_Comm_size(communicator, &size), "MPI_Comm_size");
  return size;
}

void give_up(const std::string& role, const std::string& message) {
  fmt::print(stderr, "{}: {}\n", role, message);
  note_told(Told::failure);
  end_job(exit_run_failed);
}

bool initialise_mpi(const std::string& role) {
  int initialised = 0;
  MPI_Initialized(&initialised);
  if (initialised) return false;
  report_signals();
  prepare_process();
  prepare_open_mpi();
  const Start start;
  const Guard guard(0.1, [&](double seconds) { check_initialising(seconds, role, start); });
  MPI_Init(nullptr, nullptr);
  prepare_process();  // MPI may have bound the process to a core
  return true;
}

Spawned spawn(const Program& program, const std::string& master_role) {
  const std::string executable = find_executable(program);
  const std::string node = program.node.empty() ? own_node() : program.node;
  const PidFile file;
  std::vector<std::string> words{"-c", starter, file.path()};
  if (!node.empty())
    for (std::string& word : told_on(node)) words.push_back(std::move(word));
  words.push_back(executable);
  words.insert(words.end(), program.arguments.begin(), program.arguments.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  SpawnCheck check(file, program.role, executable, master_role);
  const Guard guard(0.1, [&check](double seconds) { check(seconds); });
  MPI_Info info = spawn_info(node);
  MPI_Comm children = MPI_COMM_NULL;
  const int code = MPI_Comm_spawn("/bin/sh", arguments.data(), program.processes, info, 0, MPI_COMM_SELF, &children,
                                  MPI_ERRCODES_IGNORE);
  MPI_Info_free(&info);
  check_mpi(code, ("starting " + executable).c_str());
  const std::int64_t pid = file.pid();
  return {children, pid == 0 ? Peer{program.role} : Peer{program.role, host_name(), pid}};
}

MPI_Comm meet(int other_rank, int tag, const std::string& other_role, const std::string& own_role) {
  const Guard guard(0.2, [&](double seconds) {
    if (seconds > start_limit())
      give_up(own_role, fmt::format("{} (rank {}) did not connect within {} s", other_role, other_rank, start_limit()));
  });
  MPI_Comm pair = MPI_COMM_NULL;
  check_mpi(MPI_Intercomm_create(MPI_COMM_SELF, 0, MPI_COMM_WORLD, other_rank, tag, &pair), "MPI_Intercomm_create");
  return pair;
}

}  // namespace tether::protocol
