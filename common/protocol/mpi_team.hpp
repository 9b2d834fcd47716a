#pragma once

#include <mpi.h>

#include "common/base/team.hpp"

/// Only for this room's .cpp files.
namespace tether::protocol {

/// The processes of an MPI communicator, which is theirs alone as long as this lives.
class MpiTeam final : public Team {
 public:
  explicit MpiTeam(MPI_Comm communicator);
  using Team::sum;
  void sum(std::span<double> values) override;
  void gather(std::span<double> all, std::span<const int> starts) override;
  void exchange(std::span<const Parcel> outgoing, std::span<const Parcel> incoming) override;
  std::string text_of(int rank, const std::string& text) override;
  int communicator() const override { return MPI_Comm_c2f(communicator_); }

 private:
  MPI_Comm communicator_;
};

}  // namespace tether::protocol
