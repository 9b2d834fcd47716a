#pragma once

#include <mpi.h>

#include "common/protocol/spawn.hpp"
#include "common/protocol/watch.hpp"

/// Only for this room's .cpp files: what needs mpi.h.
namespace tether::protocol {

/// Packets as MPI messages (tag: the packet's kind) to rank 0 of an intercommunicator's other side.
/// Never blocks inside MPI: a dead peer would hang it.
class MpiChannel final : public Channel {
 public:
  enum class To { partner, master };
  /// The channel becomes the owner of `communicator`; `watch` must outlive it. Only a wait for a partner ends with
  /// PeerDied or Interrupted; a process that waits for its master ends with it.
  MpiChannel(To to, Peer peer, MPI_Comm communicator, Watch& watch);
  ~MpiChannel() override;
  void send(Packet packet) override;
  Packet receive(double limit) override;
  bool has_packet() override;
  void flush() override;
  void close(int exit_code) override;

 private:
  bool probe(int tag, MPI_Message& message, MPI_Status& status) const;
  Packet take(MPI_Message message, const MPI_Status& status);
  static bool is_finished(MPI_Request& request);
  bool wait_until(const std::function<bool()>& done, double limit, const std::function<bool()>& will_ring = {}) const;
  void wait(MPI_Request& request, double limit);
  void hear_failure();

  To to_;
  MPI_Comm communicator_;
  Watch& watch_;
  Bytes outgoing_;
  MPI_Request sending_ = MPI_REQUEST_NULL;
  bool rings_ = false;  ///< the peer, when it has sent something
};

}  // namespace tether::protocol
