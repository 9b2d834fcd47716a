#include "common/protocol/mpi_channel.hpp"

#include <fcntl.h>
#include <unistd.h>

#include "common/protocol/bell.hpp"
#include "common/protocol/deadline.hpp"
#include "common/protocol/job.hpp"
#include "common/protocol/messages.hpp"
#include "common/protocol/nodes.hpp"
#include "common/protocol/signals.hpp"

namespace tether::protocol {

namespace {
/// Seconds that the other end may take for the same call, on a machine however busy. The master ends the job first: a
/// partner that ends on its own is a failure to Open MPI.
constexpr double master_waits = 10, partner_waits = 20;
/// MPI sees what lies in a socket at the second probe. Not many more: on a busy machine each gives the core away.
constexpr int rounds_of_progress = 4;

/// While it lives nothing is said: if a job fails, it has been told why, and Open MPI logs that its servers go away
/// while leave is taken. A partner does not know whether the job fails; its master tells.
class Silence {
 public:
  explicit Silence(bool is_on) : errors_(is_on ? fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3) : -1) {
    const int nothing = errors_ >= 0 ? open("/dev/null", O_WRONLY | O_CLOEXEC) : -1;
    if (nothing < 0) return;
    dup2(nothing, STDERR_FILENO);
    ::close(nothing);
  }
  ~Silence() {
    if (errors_ < 0) return;
    dup2(errors_, STDERR_FILENO);
    ::close(errors_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  int errors_;
};
}  // namespace

MpiChannel::MpiChannel(To to, Peer peer, MPI_Comm communicator, Watch& watch)
    : Channel(std::move(peer)), to_(to), communicator_(communicator), watch_(watch) {
  check_mpi(MPI_Comm_set_errhandler(communicator_, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  if (to == To::partner)
    watch_.add_partner(this->peer(), [this] { hear_failure(); });
  else
    watch_.add_master(this->peer());
}

MpiChannel::~MpiChannel() {
  watch_.abandon(peer());
}

void MpiChannel::send(Packet packet) {
  flush();
  outgoing_ = std::move(packet.bytes);
  check_mpi(MPI_Isend(outgoing_.data(), static_cast<int>(outgoing_.size()), MPI_BYTE, 0, packet.kind, communicator_,
                      &sending_),
            "MPI_Isend");
  rings_ = Bell::own().ring(peer());
}

Packet MpiChannel::receive(double limit) {
  MPI_Message message = MPI_MESSAGE_NULL;
  MPI_Status status;
  // A long packet leaves only while this process looks after it.
  const auto will_ring = [this] { return rings_ && is_finished(sending_); };
  if (!wait_until([&] { return probe(MPI_ANY_TAG, message, status); }, limit, will_ring))
    throw PeerSilent(peer(), limit);
  return take(message, status);
}

bool MpiChannel::probe(int tag, MPI_Message& message, MPI_Status& status) const {
  int flag = 0;
  check_mpi(MPI_Improbe(0, tag, communicator_, &flag, &message, &status), "MPI_Improbe");
  return flag != 0;
}

bool MpiChannel::has_packet() {
  int flag = 0;
  check_mpi(MPI_Iprobe(0, MPI_ANY_TAG, communicator_, &flag, MPI_STATUS_IGNORE), "MPI_Iprobe");
  return flag != 0;
}

Packet MpiChannel::take(MPI_Message message, const MPI_Status& status) {
  int size = 0;
  check_mpi(MPI_Get_count(&status, MPI_BYTE, &size), "MPI_Get_count");
  Packet packet{status.MPI_TAG, Bytes(static_cast<std::size_t>(size))};
  MPI_Request receiving = MPI_REQUEST_NULL;
  check_mpi(MPI_Imrecv(packet.bytes.data(), size, MPI_BYTE, &message, &receiving), "MPI_Imrecv");
  wait(receiving, infinite);
  return packet;
}

void MpiChannel::close(int exit_code) {
  flush();
  watch_.release(peer());
  // Nobody to take leave of, or nobody who would see to it: MPI would complain. Over several nodes mpirun interrupts
  // where one is lost.
  const bool may_be_lost = exit_code != exit_done && interrupted() && !own_node().empty();
  if (launcher_is_gone() || may_be_lost || (to_ == To::master && is_dead(peer()))) end_job(exit_code);
  const double limit = to_ == To::partner ? master_waits : partner_waits;
  const Deadline deadline(limit, exit_code);
  const Silence silence(exit_code != exit_done || to_ == To::master || !own_node().empty());
  if (MPI_Comm_disconnect(&communicator_) != MPI_SUCCESS) end_job(exit_code);  // the launcher has just gone
}

/// Throws RunError if there is a Failure: a partner's last words.
void MpiChannel::hear_failure() {
  MPI_Message message = MPI_MESSAGE_NULL;
  MPI_Status status;
  for (int round = 0; round < rounds_of_progress; ++round)
    if (probe(kind_of<Failure, ToMaster>, message, status))
      throw RunError(peer().failure(unpack<Failure>(take(message, status)).message));
}

void MpiChannel::flush() {
  wait(sending_, infinite);
}

bool MpiChannel::is_finished(MPI_Request& request) {
  int flag = 0;
  check_mpi(MPI_Test(&request, &flag, MPI_STATUS_IGNORE), "MPI_Test");
  return flag != 0;
}

bool MpiChannel::wait_until(const std::function<bool()>& done, double limit,
                            const std::function<bool()>& will_ring) const {
  return protocol::wait_until(
      done,
      [this] {
        if (to_ == To::partner) watch_.check_partners();
      },
      limit, will_ring);
}

void MpiChannel::wait(MPI_Request& request, double limit) {
  if (!wait_until([&] { return is_finished(request); }, limit)) throw PeerSilent(peer(), limit);
}

}  // namespace tether::protocol
