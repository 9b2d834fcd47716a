#include "common/protocol/company.hpp"

#include <vector>

#include "common/protocol/bell.hpp"
#include "common/protocol/fellows.hpp"
#include "common/protocol/job.hpp"
#include "common/protocol/last_words.hpp"
#include "common/protocol/messages.hpp"
#include "common/protocol/mpi_team.hpp"
#include "common/protocol/spawn.hpp"
#include "common/protocol/watch.hpp"

namespace tether::protocol {
namespace {

/// [s] that the leader may take to hear that another has failed: it may be in the middle of what all should do
/// together, and then waits for ever.
constexpr double hearing_limit = 30;
/// Of the messages that say how work on a packet ended; packets have the tag of their kind.
constexpr int settled_tag = 1000;

MPI_Comm duplicate(MPI_Comm communicator) {
  MPI_Comm result = MPI_COMM_NULL;
  check_mpi(MPI_Comm_dup(communicator, &result), "MPI_Comm_dup");
  check_mpi(MPI_Comm_set_errhandler(result, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  return result;
}

}  // namespace

struct Company::Parts {
  Parts(const std::string& role, MPI_Comm all)
      : work(duplicate(all)), talk(duplicate(all)), team(work), fellows(role, MPI_Comm_c2f(talk)) {}

  static bool is_finished(MPI_Request& request) {
    int flag = 0;
    check_mpi(MPI_Test(&request, &flag, MPI_STATUS_IGNORE), "MPI_Test");
    return flag != 0;
  }
  Packet receive(int rank, int tag, bool will_ring) {
    MPI_Message message = MPI_MESSAGE_NULL;
    MPI_Status status;
    const auto has_come = [&] {
      int flag = 0;
      check_mpi(MPI_Improbe(rank, tag, talk, &flag, &message, &status), "MPI_Improbe");
      return flag != 0;
    };
    wait_until(
        has_come, [] {}, infinite, [will_ring] { return will_ring; });
    int size = 0;
    check_mpi(MPI_Get_count(&status, MPI_BYTE, &size), "MPI_Get_count");
    Packet packet{status.MPI_TAG, Bytes(static_cast<std::size_t>(size))};
    check_mpi(MPI_Mrecv(packet.bytes.data(), size, MPI_BYTE, &message, MPI_STATUS_IGNORE), "MPI_Mrecv");
    return packet;
  }
  void pass_on(const Packet& packet) {
    std::vector<MPI_Request> under_way(fellows.peers().size(), MPI_REQUEST_NULL);
    for (int rank = 1; rank < team.size(); ++rank) {
      MPI_Request& request = under_way[static_cast<std::size_t>(rank)];
      check_mpi(MPI_Isend(packet.bytes.data(), static_cast<int>(packet.bytes.size()), MPI_BYTE, rank, packet.kind, talk,
                          &request),
                "MPI_Isend");
      Bell::own().ring(fellows.peers()[static_cast<std::size_t>(rank)]);
    }
    for (MPI_Request& request : under_way) wait_until([&request] { return is_finished(request); }, [] {});
  }

  MPI_Comm work, talk;
  MpiTeam team;
  Fellows fellows;
};

Company::Company(const std::string& role, const Session& session)
    : parts_(std::make_unique<Parts>(role, MPI_Comm_f2c(session.communicator()))) {}

Company::~Company() = default;

Team& Company::team() {
  return parts_->team;
}

Packet Company::shared(Packet of_leader) {
  if (team().rank() != 0) return parts_->receive(0, MPI_ANY_TAG, true);
  parts_->pass_on(of_leader);
  return of_leader;
}

std::string Company::settled(const std::string& failure) {
  if (team().rank() != 0) {
    MPI_Request request = MPI_REQUEST_NULL;
    check_mpi(
        MPI_Issend(failure.data(), static_cast<int>(failure.size()), MPI_BYTE, 0, settled_tag, parts_->talk, &request),
        "MPI_Issend");
    const auto is_heard = [&request] { return Parts::is_finished(request); };
    if (!wait_until(
            is_heard, [] {}, failure.empty() ? infinite : hearing_limit))
      give_up(failure);
    return failure;
  }
  std::string first;
  for (int rank = 1; rank < team().size(); ++rank) {
    const Packet packet = parts_->receive(rank, settled_tag, false);
    const std::string said(reinterpret_cast<const char*>(packet.bytes.data()), packet.bytes.size());
    if (first.empty() && !said.empty()) first = parts_->fellows.peers()[static_cast<std::size_t>(rank)].failure(said);
  }
  return first;
}

void Company::give_up(const std::string& why) const {
  leave_last_words(why);
  end_job(exit_run_failed);
}

void Company::part() {
  parts_->fellows.part();
}

}  // namespace tether::protocol
