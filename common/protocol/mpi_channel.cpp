#include "common/protocol/mpi_channel.hpp"

#include "common/protocol/job.hpp"

namespace tether::protocol {

namespace {
constexpr double close_limit = 3;  // seconds that the other end may take for the same call
}

MpiChannel::MpiChannel(Peer peer, MPI_Comm communicator, Watch& watch)
    : Channel(std::move(peer)), communicator_(communicator), watch_(watch) {
  check_mpi(MPI_Comm_set_errhandler(communicator_, MPI_ERRORS_RETURN), "MPI_Comm_set_errhandler");
  watch_.add(this->peer());
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
}

Packet MpiChannel::receive(double limit) {
  MPI_Message message = MPI_MESSAGE_NULL;
  MPI_Status status;
  const auto arrived = [&] {
    int flag = 0;
    check_mpi(MPI_Improbe(0, MPI_ANY_TAG, communicator_, &flag, &message, &status), "MPI_Improbe");
    return flag != 0;
  };
  if (!wait_until(arrived, watch_, limit)) throw PeerSilent(peer(), limit);
  int size = 0;
  check_mpi(MPI_Get_count(&status, MPI_BYTE, &size), "MPI_Get_count");
  Packet packet{status.MPI_TAG, Bytes(static_cast<std::size_t>(size))};
  MPI_Request receiving = MPI_REQUEST_NULL;
  check_mpi(MPI_Imrecv(packet.bytes.data(), size, MPI_BYTE, &message, &receiving), "MPI_Imrecv");
  wait(receiving, infinite);
  return packet;
}

void MpiChannel::close() {
  flush();
  watch_.release(peer());
  const Guard deadline(0.5, [](double seconds) {
    if (seconds > close_limit) end_job(exit_run_failed);
  });
  check_mpi(MPI_Comm_disconnect(&communicator_), "MPI_Comm_disconnect");
}

void MpiChannel::flush() {
  wait(sending_, infinite);
}

void MpiChannel::wait(MPI_Request& request, double limit) {
  const auto finished = [&] {
    int flag = 0;
    check_mpi(MPI_Test(&request, &flag, MPI_STATUS_IGNORE), "MPI_Test");
    return flag != 0;
  };
  if (!wait_until(finished, watch_, limit)) throw PeerSilent(peer(), limit);
}

}  // namespace tether::protocol
