#include "common/protocol/launch.hpp"

#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "common/base/process.hpp"
#include "common/protocol/mpi_channel.hpp"
#include "common/protocol/roster.hpp"

namespace tether::protocol {

struct Session::Parts {
  std::string role;
  bool owns_mpi = false;
  bool is_leader = true;
  MPI_Comm parent = MPI_COMM_NULL;
  int rank = 0;
  std::vector<std::string> roles;  // by world rank, on an MPMD line
  Watch watch;
};

namespace {

/// What Open MPI must know before MPI_Init, unless the user said otherwise: more processes than cores, none bound to
/// one.
void prepare_open_mpi() {
  setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 0);
  setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
  setenv("OMPI_MCA_hwloc_base_binding_policy", "none", 0);
}

bool initialise_mpi() {
  int initialised = 0;
  MPI_Initialized(&initialised);
  if (initialised) return false;
  prepare_process();
  prepare_open_mpi();
  MPI_Init(nullptr, nullptr);
  prepare_process();  // MPI may have bound the process to a core
  return true;
}

bool leads(int communicator) {
  if (communicator == no_communicator) return true;
  int rank = 0;
  MPI_Comm_rank(MPI_Comm_f2c(communicator), &rank);
  return rank == 0;
}

/// Everybody's role by world rank.
std::vector<std::string> gather_roles(const std::string& role) {
  int size = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  std::array<char, 64> mine{};
  role.copy(mine.data(), mine.size() - 1);
  std::vector<std::array<char, 64>> all(static_cast<std::size_t>(size));
  check_mpi(MPI_Allgather(mine.data(), 64, MPI_CHAR, all.data(), 64, MPI_CHAR, MPI_COMM_WORLD), "MPI_Allgather");
  std::vector<std::string> roles;
  for (const auto& one : all) roles.emplace_back(one.data());
  return roles;
}

MPI_Comm spawn(const Program& program) {
  const std::string executable = find_executable(program);
  std::vector<char*> arguments;
  for (const std::string& argument : program.arguments) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  MPI_Info info = MPI_INFO_NULL;
  MPI_Info_create(&info);
  MPI_Info_set(info, "wdir", std::filesystem::current_path().c_str());
  MPI_Comm children = MPI_COMM_NULL;
  const int code = MPI_Comm_spawn(executable.c_str(), arguments.data(), program.processes, info, 0, MPI_COMM_SELF,
                                  &children, MPI_ERRCODES_IGNORE);
  MPI_Info_free(&info);
  check_mpi(code, ("starting " + executable).c_str());
  return children;
}

/// The two ends of one pair on an MPMD line; `tag`: the partner's world rank.
MPI_Comm meet(int other_rank, int tag) {
  MPI_Comm pair = MPI_COMM_NULL;
  check_mpi(MPI_Intercomm_create(MPI_COMM_SELF, 0, MPI_COMM_WORLD, other_rank, tag, &pair), "MPI_Intercomm_create");
  return pair;
}

/// Reads Arrival, answers Welcome.
void welcome(Channel& partner, const std::string& output, double limit) {
  const Packet packet = partner.receive(limit);
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
  if (arrival.role != peer.role) throw input_error("{} says that it is a {}", peer.describe(), arrival.role);
  partner.send(pack(Welcome{version, host_name(), process_id(), output}));
}

}  // namespace

std::string find_executable(const Program& program) {
  namespace fs = std::filesystem;
  const fs::path given(program.executable);
  const fs::path path =
      given.has_parent_path() ? fs::absolute(given) : fs::read_symlink("/proc/self/exe").parent_path() / given;
  if (!fs::exists(path)) throw input_error("program of the {}: {} does not exist", program.role, path.string());
  if (!fs::is_regular_file(path) || access(path.c_str(), X_OK) != 0)
    throw input_error("program of the {}: {} cannot be executed", program.role, path.string());
  return path.string();
}

Session::Session(const std::string& role, int communicator) : parts_(std::make_unique<Parts>()) {
  parts_->owns_mpi = initialise_mpi();
  parts_->is_leader = leads(communicator);
  parts_->role = role;
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  MPI_Comm_set_errhandler(MPI_COMM_SELF, MPI_ERRORS_RETURN);
  MPI_Comm_rank(MPI_COMM_WORLD, &parts_->rank);
  MPI_Comm_get_parent(&parts_->parent);
  if (parts_->parent == MPI_COMM_NULL) parts_->roles = gather_roles(parts_->is_leader ? role : "");
}

Session::~Session() = default;

bool Session::has_master() const {
  return parts_->parent != MPI_COMM_NULL || (!parts_->roles.empty() && master_of(parts_->roles, parts_->rank) >= 0);
}

bool Session::is_leader() const {
  return parts_->is_leader;
}

Session::Link Session::connect() {
  if (!has_master())
    throw run_error("no master: this program is started by one, or beside one on an mpirun line (docs/protocol.md)");
  const bool spawned = parts_->parent != MPI_COMM_NULL;
  const MPI_Comm communicator = spawned ? parts_->parent : meet(master_of(parts_->roles, parts_->rank), parts_->rank);
  auto channel = std::make_unique<MpiChannel>(Peer{"the master"}, communicator, parts_->watch);
  channel->send(pack(Arrival{version, parts_->role, host_name(), process_id()}));
  const auto greeting = unpack<Welcome>(channel->receive(infinite));
  channel->peer().host = greeting.host;
  channel->peer().pid = greeting.pid;
  parts_->watch.follow(channel->peer());
  return {std::move(channel), greeting};
}

std::vector<Partner> Session::launch(const std::vector<Program>& programs, const std::string& output, double limit) {
  std::vector<std::unique_ptr<Channel>> channels;
  std::vector<int> free = parts_->roles.size() > 1 ? partners_of(parts_->roles, parts_->rank) : std::vector<int>{};
  for (const Program& program : programs) {
    const auto is_such = [&](int rank) { return parts_->roles[static_cast<std::size_t>(rank)] == program.role; };
    const auto found = std::find_if(free.begin(), free.end(), is_such);
    if (parts_->roles.size() > 1 && found == free.end())
      throw input_error("the mpirun line has no {} for this {}", program.role, parts_->role);
    const MPI_Comm pair = found == free.end() ? spawn(program) : meet(*found, *found);
    if (found != free.end()) free.erase(found);
    channels.push_back(std::make_unique<MpiChannel>(Peer{program.role}, pair, parts_->watch));
  }
  std::vector<Partner> partners;
  for (auto& channel : channels) {
    welcome(*channel, output, limit);
    partners.emplace_back(std::move(channel));
  }
  return partners;
}

int Session::end(int exit_code) {
  if (!parts_->watch.all_released()) {
    for (const Peer& peer : parts_->watch.abandoned())
      if (peer.pid != 0 && peer.host == host_name() && parts_->parent == MPI_COMM_NULL)
        kill(static_cast<pid_t>(peer.pid), SIGKILL);
    MPI_Abort(MPI_COMM_WORLD, exit_code);
  }
  if (parts_->owns_mpi) MPI_Finalize();
  return exit_code;
}

}  // namespace tether::protocol
