#include "common/protocol/launch.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <list>
#include <map>
#include <thread>

#include "common/base/limits.hpp"
#include "common/base/process.hpp"
#include "common/protocol/deadline.hpp"
#include "common/protocol/job.hpp"
#include "common/protocol/mpi_channel.hpp"
#include "common/protocol/roster.hpp"
#include "common/protocol/signals.hpp"
#include "common/protocol/spawn.hpp"

namespace tether::protocol {

struct Session::Parts {
  std::string role;
  bool owns_mpi = false;
  bool is_leader = true;
  MPI_Comm parent = MPI_COMM_NULL, own = MPI_COMM_SELF;
  int rank = 0;
  std::vector<std::string> roles;  // by world rank, if this process was not spawned
  Watch watch;
  std::list<std::vector<Partner>> groups;  // of each launch; after `watch`, which their channels use

  std::vector<Partner*> partners() {
    std::vector<Partner*> all;
    for (auto& group : groups)
      for (Partner& partner : group) all.push_back(&partner);
    return all;
  }
  MPI_Comm meet_master() const { return meet(master_of(roles, rank), rank, "the master", role); }
  std::unique_ptr<Channel> start(const Program& program) {
    auto [communicator, peer] = spawn(program, role);
    return std::make_unique<MpiChannel>(MpiChannel::To::partner, peer, communicator, watch);
  }
  /// The first of the candidates (world ranks) that has a role.
  std::vector<int>::iterator first_with(const std::string& wanted, std::vector<int>& candidates) const {
    return std::find_if(candidates.begin(), candidates.end(),
                        [&](int candidate) { return roles[static_cast<std::size_t>(candidate)] == wanted; });
  }
  bool has(const std::string& wanted, std::vector<int>& candidates) const {
    return first_with(wanted, candidates) != candidates.end();
  }
  std::unique_ptr<Channel> take(const Program& program, std::vector<int>& candidates) {
    const auto found = first_with(program.role, candidates);
    if (found == candidates.end()) throw input_error("the mpirun line has no {} for this {}", program.role, role);
    const int partner = *found;
    candidates.erase(found);
    const MPI_Comm communicator = meet(partner, partner, program.role, role);
    return std::make_unique<MpiChannel>(MpiChannel::To::partner, Peer{program.role}, communicator, watch);
  }
};

namespace {

/// Seconds. MPI_Finalize waits for all processes of an mpirun line, on a machine however busy: if one of them ends
/// without it, mpirun says that the job failed.
constexpr double finish_limit = 2, leave_limit = 5, finalize_limit = 20;

/// The processes of this program: all that were spawned together, or one part of an MPMD line.
MPI_Comm own_processes(bool spawned) {
  if (spawned) return MPI_COMM_WORLD;
  int *application = nullptr, found = 0;
  MPI_Comm_get_attr(MPI_COMM_WORLD, MPI_APPNUM, &application, &found);
  MPI_Comm own = MPI_COMM_NULL;
  check_mpi(MPI_Comm_split(MPI_COMM_WORLD, found ? *application : 0, 0, &own), "MPI_Comm_split");
  return own;
}

/// Which of an mpirun line's processes one master has is not known before all have told who they are.
MPI_Comm chosen(int communicator, MPI_Comm own, bool spawned) {
  if (communicator == no_communicator || (communicator == one_masters && !spawned)) return MPI_COMM_SELF;
  return communicator == all_processes || communicator == one_masters ? own : MPI_Comm_f2c(communicator);
}

/// Ends a program that was started in several processes (coupling.ranks), each of which would answer the master alone.
void refuse_company(const std::string& role, int rank) {
  const int size = size_of(MPI_COMM_WORLD);
  if (size == 1) return;
  if (rank == 0)
    give_up(role, fmt::format("{} processes (coupling.ranks), each of which would answer alone: let them serve "
                              "together (Python: together=True; C: a communicator for tether_connect)",
                              size));
  std::this_thread::sleep_for(std::chrono::seconds(1));
  end_job(exit_run_failed);
}

/// Who a process of an mpirun line is. Its bytes are what programs of earlier versions exchange, whose last are zeros.
struct Present {
  std::array<char, 55> role{};
  char shares_master = 0;  ///< whether all processes of its role that have one master are one code
  std::uint64_t of_case = 0;
};

/// Of everybody, by world rank.
std::vector<Present> gather_present(const std::string& role, bool shares_master, const OfCase& of_case) {
  std::vector<Present> all(static_cast<std::size_t>(size_of(MPI_COMM_WORLD)));
  Present mine;
  role.copy(mine.role.data(), mine.role.size() - 1);
  mine.shares_master = shares_master ? 1 : 0;
  if (of_case && !role.empty() && all.size() > 1) mine.of_case = of_case();
  check_mpi(MPI_Allgather(&mine, sizeof mine, MPI_BYTE, all.data(), sizeof mine, MPI_BYTE, MPI_COMM_WORLD),
            "MPI_Allgather");
  return all;
}

std::vector<std::string> roles_of(const std::vector<Present>& present) {
  std::vector<std::string> roles;
  for (const Present& one : present) roles.emplace_back(one.role.data());
  return roles;
}

/// Throws InputError if there is more than one run, or if somebody has no master of his own, or another case than his
/// master.
void check_line(const std::vector<Present>& present) {
  const std::vector<std::string> roles = roles_of(present);
  check_one_leads(roles);
  for (std::size_t one = 0; one < roles.size(); ++one) {
    const int master = master_of(roles, static_cast<int>(one));
    if (master < 0) continue;
    const std::uint64_t mine = present[one].of_case, theirs = present[static_cast<std::size_t>(master)].of_case;
    if (mine != 0 && theirs != 0 && mine != theirs)
      throw input_error("a {} of the mpirun line has another case than its {}: give all of them the same", roles[one],
                        roles[static_cast<std::size_t>(master)]);
  }
}

/// What everybody sees one says; mpirun ends the others no sooner than that is said.
void check_line(const std::vector<Present>& present, int rank) {
  try {
    check_line(present);
  } catch (const InputError&) {
    if (rank == 0) throw;
    std::this_thread::sleep_for(std::chrono::seconds(1));
    end_job(exit_input_wrong);
  }
}

/// The world ranks of each code in several processes; of a code in one it has that.
std::vector<std::vector<int>> teams_of(const std::vector<Present>& present) {
  const std::vector<std::string> roles = roles_of(present);
  std::map<std::pair<std::string, int>, std::vector<int>> of_masters;
  std::vector<std::vector<int>> teams(roles.size());
  for (std::size_t one = 0; one < roles.size(); ++one) {
    const int rank = static_cast<int>(one), master = present[one].shares_master != 0 ? master_of(roles, rank) : -1;
    if (master >= 0) of_masters[{roles[one], master}].push_back(rank);
    teams[one] = {rank};
  }
  for (const auto& [whose, ranks] : of_masters)
    for (const int rank : ranks) teams[static_cast<std::size_t>(rank)] = ranks;
  return teams;
}

/// Who leads its code, by world rank; the others have no role.
std::vector<std::string> roles_of_leaders(const std::vector<Present>& present,
                                          const std::vector<std::vector<int>>& teams) {
  std::vector<std::string> roles = roles_of(present);
  for (std::size_t one = 0; one < roles.size(); ++one)
    if (teams[one].front() != static_cast<int>(one)) roles[one].clear();
  return roles;
}

/// Collective over these world ranks only.
MPI_Comm communicator_of(const std::vector<int>& ranks) {
  if (ranks.size() == 1) return MPI_COMM_SELF;
  constexpr int tag = 0;
  MPI_Group world = MPI_GROUP_NULL, group = MPI_GROUP_NULL;
  MPI_Comm result = MPI_COMM_NULL;
  MPI_Comm_group(MPI_COMM_WORLD, &world);
  MPI_Group_incl(world, static_cast<int>(ranks.size()), ranks.data(), &group);
  check_mpi(MPI_Comm_create_group(MPI_COMM_WORLD, group, tag, &result), "MPI_Comm_create_group");
  MPI_Group_free(&group);
  MPI_Group_free(&world);
  return result;
}

/// Reads Arrival, answers Welcome.
void welcome(Channel& partner, const std::string& output) {
  const Packet packet = partner.receive(start_limit());
  if (!holds<Arrival>(packet))
    throw run_error("{} did not begin with Arrival but with {}", partner.peer().role, kind_name<ToMaster>(packet.kind));
  const auto arrival = unpack<Arrival>(packet);
  Peer& peer = partner.peer();
  peer.host = arrival.host;
  peer.pid = arrival.pid;
  peer.activity = "setting up";
  if (arrival.protocol_version != version)
    throw input_error("{} speaks version {} of the protocol, this program version {}", peer.describe(),
                      arrival.protocol_version, version);
  if (peer.role.empty()) peer.role = arrival.role;
  if (arrival.role != peer.role) throw input_error("{} says that it is a {}", peer.describe(), arrival.role);
  partner.send(pack(Welcome{version, host_name(), process_id(), output}));
}

/// Lets an idle partner finish. A dead, silent or failing one stays unfinished.
void finish_if_idle(Partner& partner, bool abrupt) {
  if (!partner.is_idle()) return;
  try {
    partner.finish({"the master ends", abrupt}, finish_limit);
  } catch (const std::exception&) {
    return;
  }
}

/// Gives partners that were told to stop the time to end: a process that is left behind is an orphan, even if only for
/// the second that an interpreter needs to end. Returns the pids that still run.
std::vector<std::int64_t> await_end(const std::vector<Peer>& partners) {
  std::vector<std::int64_t> running;
  const auto all_dead = [&] {
    running.clear();
    for (const Peer& peer : partners)
      if (peer.pid != 0 && peer.host == host_name() && !is_dead(peer)) running.push_back(peer.pid);
    return running.empty();
  };
  wait_until(
      all_dead, [] {}, leave_limit);
  return running;
}

}  // namespace

std::string find_executable(const Program& program) {
  namespace fs = std::filesystem;
  const fs::path given(program.executable);
  const fs::path path =
      is_own(program.executable) ? fs::read_symlink("/proc/self/exe").parent_path() / given : fs::absolute(given);
  const std::string whose = program.role.empty() ? "the program" : "program of the " + program.role;
  const std::string where = program.where.empty() ? whose : program.where;
  if (!fs::exists(path))
    throw input_error("{}: {} does not exist{}", where, path.string(),
                      is_own(program.executable) ? fmt::format(" (a file of your own: ./{})", given.string()) : "");
  if (!fs::is_regular_file(path) || access(path.c_str(), X_OK) != 0)
    throw input_error("{}: {} cannot be executed", where, path.string());
  return path.string();
}

Session::Session(const std::string& role, int communicator, const OfCase& of_case) : parts_(std::make_unique<Parts>()) {
  Parts& parts = *parts_;
  parts.role = role;
  parts.owns_mpi = initialise_mpi(role);
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  MPI_Comm_set_errhandler(MPI_COMM_SELF, MPI_ERRORS_RETURN);
  MPI_Comm_get_parent(&parts.parent);
  const bool spawned = parts.parent != MPI_COMM_NULL;
  if (spawned) parts.watch.follow(marking_master());
  parts.rank = rank_in(MPI_COMM_WORLD);
  if (spawned && communicator == no_communicator) refuse_company(role, parts.rank);
  parts.own = chosen(communicator, own_processes(spawned), spawned);
  parts.is_leader = rank_in(parts.own) == 0;
  if (spawned) return;
  const bool shares_master = communicator == one_masters;
  const std::vector<Present> present = gather_present(parts.is_leader ? role : "", shares_master, of_case);
  check_line(present, parts.rank);
  const std::vector<std::vector<int>> teams = teams_of(present);
  parts.roles = roles_of_leaders(present, teams);
  if (!shares_master) return;
  parts.own = communicator_of(teams[static_cast<std::size_t>(parts.rank)]);
  parts.is_leader = rank_in(parts.own) == 0;
}

Session::~Session() = default;

bool Session::has_master() const {
  return parts_->parent != MPI_COMM_NULL || (!parts_->roles.empty() && master_of(parts_->roles, parts_->rank) >= 0);
}

bool Session::is_leader() const {
  return parts_->is_leader;
}

bool Session::is_alone() const {
  return size_of(parts_->own) == 1;
}

int Session::communicator() const {
  return MPI_Comm_c2f(parts_->own);
}

Session::Link Session::connect() {
  delay_termination();
  if (!has_master())
    throw run_error("no master: this program is started by one, or beside one on an mpirun line (docs/protocol.md)");
  const bool spawned = parts_->parent != MPI_COMM_NULL;
  const MPI_Comm communicator = spawned ? parts_->parent : parts_->meet_master();
  auto channel = std::make_unique<MpiChannel>(MpiChannel::To::master, Peer{"the master"}, communicator, parts_->watch);
  channel->send(pack(Arrival{version, parts_->role, host_name(), process_id()}));
  const auto greeting = unpack<Welcome>(channel->receive(infinite));
  channel->peer().host = greeting.host;
  channel->peer().pid = greeting.pid;
  channel->peer().activity = "at work";
  parts_->watch.follow(channel->peer());
  return {std::move(channel), greeting};
}

std::optional<std::size_t> Session::offered(const std::string& role) const {
  if (parts_->roles.size() <= 1) return std::nullopt;
  const std::vector<int> partners = partners_of(parts_->roles, parts_->rank);
  return std::count_if(partners.begin(), partners.end(),
                       [&](int rank) { return parts_->roles[static_cast<std::size_t>(rank)] == role; });
}

std::span<Partner> Session::launch(const std::vector<Program>& programs, const std::string& output) {
  report_signals();
  std::vector<int> candidates;
  if (parts_->roles.size() > 1) candidates = partners_of(parts_->roles, parts_->rank);
  std::vector<Partner>& group = parts_->groups.emplace_back();
  for (const Program& program : programs) {
    if (program.here && !parts_->has(program.role, candidates)) {
      group.emplace_back(program.here(program, {version, host_name(), process_id(), output}));
      continue;
    }
    auto channel = parts_->roles.size() > 1 ? parts_->take(program, candidates) : parts_->start(program);
    welcome(*channel, output);
    group.emplace_back(std::move(channel));
  }
  if (!candidates.empty())
    throw input_error("the mpirun line has a {} too many for this {}",
                      parts_->roles[static_cast<std::size_t>(candidates.front())], parts_->role);
  return group;
}

Partner& Session::first_to_reply(std::span<Partner* const> asked) {
  Partner* first = nullptr;
  wait_until(
      [&] {
        const auto found = std::find_if(asked.begin(), asked.end(), [](const Partner* p) { return p->has_replied(); });
        if (found != asked.end()) first = *found;
        return first != nullptr;
      },
      [this] { parts_->watch.check_partners(); });
  return *first;
}

void Session::gather_processes() {
  if (parts_->parent == MPI_COMM_NULL || is_alone()) return;
  MPI_Request meeting = MPI_REQUEST_NULL;
  check_mpi(MPI_Ibarrier(parts_->own, &meeting), "MPI_Ibarrier");
  const auto have_met = [&meeting] {
    int flag = 0;
    check_mpi(MPI_Test(&meeting, &flag, MPI_STATUS_IGNORE), "MPI_Test");
    return flag != 0;
  };
  wait_until(have_met, [] {});
}

int Session::end(int exit_code) {
  if (parts_->parent != MPI_COMM_NULL && !parts_->is_leader) {
    gather_processes();
    const Deadline deadline(finalize_limit, exit_code);
    MPI_Comm_disconnect(&parts_->parent);
  }
  parts_->watch.unfollow();
  const std::vector<Partner*> partners = parts_->partners();
  const auto all = [&](auto condition) { return std::all_of(partners.begin(), partners.end(), condition); };
  const bool orderly = all([](const Partner* p) { return p->is_idle() || p->is_finished(); });
  for (Partner* partner : partners) finish_if_idle(*partner, !orderly);
  if (orderly && all([](const Partner* p) { return p->is_finished(); }))
    for (Partner* partner : partners) partner->close(exit_code);
  std::vector<Peer> peers;
  for (const Partner* partner : partners) peers.push_back(partner->peer());
  parts_->groups.clear();
  if (!parts_->watch.all_released()) end_job(exit_code, parts_->watch.abandoned_partners());
  const bool spawned_them = parts_->roles.size() <= 1;  // of an mpirun line all end together, in MPI_Finalize
  const std::vector<std::int64_t> running = spawned_them ? await_end(peers) : std::vector<std::int64_t>{};
  const Deadline deadline(finalize_limit, exit_code);
  if (exit_code != exit_done || !running.empty()) leave_reaper(running);
  if (parts_->owns_mpi) MPI_Finalize();
  return exit_code;
}

}  // namespace tether::protocol
