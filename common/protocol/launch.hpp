#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/protocol/partner.hpp"

/// How masters and partners find each other: a master spawns its partners, or one MPMD mpirun line starts everybody.
/// The same executables work both ways; docs/decisions/0002 tells what was measured.
namespace tether::protocol {

struct Program;
/// Makes a partner in this process, which is told what it would be told on arrival.
using Here = std::function<std::unique_ptr<Channel>(const Program&, const Welcome&)>;

/// A program to be launched as a partner.
struct Program {
  std::string role;                    ///< "fluid"; empty: whatever the spawned program says it is
  std::string executable;              ///< a path; a name without slash is looked for beside the running program
  std::vector<std::string> arguments;  ///< the case file, options
  int processes = 1;                   ///< of a parallel code; only its rank 0 talks
  std::string where = {};              ///< that the user named it, for messages: "case.yaml:4: coupling.programs.fluid"
  std::string node = {};               ///< to run on; empty: the one of its master
  Here here = {};                      ///< instead of a process of its own, unless the mpirun line holds one
};

/// Whether a program that a case names is Tether's own: without slash.
inline bool is_own(const std::string& executable) {
  return executable.find('/') == std::string::npos;
}

/// The file to execute. Throws InputError if there is none or it may not be executed.
std::string find_executable(const Program& program);

/// A hash of the case that a program was given, and of all files that it names; 0: it does not know. Asked for where an
/// mpirun line started the others, who may have been given another.
using OfCase = std::function<std::uint64_t()>;

/// Instead of a communicator: this process alone; all processes that run this program; or those of them that one master
/// has, as Tether's own codes: the n fluids of an mpirun line with m masters are m teams, in rank order.
inline constexpr int no_communicator = -1, all_processes = -2, one_masters = -3;

/// The membership of this process in the job, from MPI_Init to MPI_Finalize: one per process, first thing in main.
class Session {
 public:
  /// `communicator`: Fortran handle (MPI_Comm_c2f) of the processes of one parallel code, or one of the above; only its
  /// rank 0 takes the role. On an MPMD line this call is collective over MPI_COMM_WORLD. Throws InputError, in one of
  /// its processes, if there are not as many of each as their masters need, or masters of two runs; the others end.
  explicit Session(const std::string& role, int communicator = no_communicator, const OfCase& of_case = {});
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  bool has_master() const;
  /// Whether this process talks: rank 0 of its code.
  bool is_leader() const;
  /// Whether its code has no other process.
  bool is_alone() const;
  /// Fortran handle of the processes of this code.
  int communicator() const;

  /// A partner's way to its master, and what it is told on arrival.
  struct Link {
    std::unique_ptr<Channel> channel;
    Welcome welcome;
  };
  /// Throws RunError if there is no master.
  Link connect();

  /// How many programs of a role the mpirun line holds for this master; nothing if it spawns its partners.
  std::optional<std::size_t> offered(const std::string& role) const;

  /// Spawns the programs, or takes those of the same roles from the mpirun line, and welcomes them; they read their
  /// case at the same time until each is asked for its hello. The session keeps the partners, in the programs' order.
  /// Waits at most TETHER_START_LIMIT seconds (60 if unset) for each to appear.
  /// Throws InputError (no such executable, another role, version or case), PeerDied, PeerSilent.
  std::span<Partner> launch(const std::vector<Program>& programs, const std::string& output);

  /// The first of some partners, each with a request under way, whose reply is there. Waits for it. Throws PeerDied,
  /// Interrupted.
  Partner& first_to_reply(std::span<Partner* const> asked);

  /// The processes of a spawned code take leave of its master all together, as MPI asks: they wait for each other here,
  /// the leader before it closes its link.
  void gather_processes();

  /// Ends the job, the last thing in main. Partners that wait for a request are stopped. If all ended in good order:
  /// MPI_Finalize, and returns `exit_code`. Otherwise (a partner is dead, busy or lost) does not return: ends this
  /// process with `exit_code`, and all it launched, within a second.
  int end(int exit_code);

  struct Parts;

 private:
  std::unique_ptr<Parts> parts_;
};

}  // namespace tether::protocol
