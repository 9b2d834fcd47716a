#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/protocol/channel.hpp"

namespace tether::protocol {

class Guard;

/// The processes of one code, and who they are. The leader (rank 0) looks after the others from a thread: it may hang
/// inside MPI when one of them dies or is stopped. It then ends, and leaves word why for its master. In the others a
/// signal to end takes effect later (delay_termination). All construct it at the same time.
class Fellows {
 public:
  /// `communicator`: Fortran handle (MPI_Comm_c2f) of these processes.
  Fellows(std::string role, int communicator);
  ~Fellows();
  Fellows(const Fellows&) = delete;
  Fellows& operator=(const Fellows&) = delete;

  /// By rank.
  const std::vector<Peer>& peers() const { return peers_; }
  /// From now on processes may end.
  void part();

 private:
  void look_after_others();
  [[noreturn]] void end_because(const std::string& why) const;

  std::string role_;
  std::vector<Peer> peers_;
  std::unique_ptr<Guard> guard_;
};

}  // namespace tether::protocol
