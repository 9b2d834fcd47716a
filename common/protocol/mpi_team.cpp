#include "common/protocol/mpi_team.hpp"

#include <vector>

#include "common/protocol/spawn.hpp"

namespace tether::protocol {
namespace {

int count(std::span<const double> values) {
  return static_cast<int>(values.size());
}

}  // namespace

MpiTeam::MpiTeam(MPI_Comm communicator)
    : Team(rank_in(communicator), size_of(communicator)), communicator_(communicator) {}

/// What one process has summed goes to all: MPI promises equal bits no other way.
void MpiTeam::sum(std::span<double> values) {
  const void* mine = rank() == 0 ? MPI_IN_PLACE : values.data();
  check_mpi(MPI_Reduce(mine, values.data(), count(values), MPI_DOUBLE, MPI_SUM, 0, communicator_), "MPI_Reduce");
  check_mpi(MPI_Bcast(values.data(), count(values), MPI_DOUBLE, 0, communicator_), "MPI_Bcast");
}

void MpiTeam::gather(std::span<double> all, std::span<const int> starts) {
  std::vector<int> counts;
  for (std::size_t r = 0; r + 1 < starts.size(); ++r) counts.push_back(starts[r + 1] - starts[r]);
  check_mpi(MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, all.data(), counts.data(), starts.data(), MPI_DOUBLE,
                           communicator_),
            "MPI_Allgatherv");
}

void MpiTeam::exchange(std::span<const Parcel> outgoing, std::span<const Parcel> incoming) {
  constexpr int tag = 0;
  std::vector<MPI_Request> under_way;
  for (const Parcel& parcel : incoming)
    check_mpi(MPI_Irecv(parcel.values.data(), count(parcel.values), MPI_DOUBLE, parcel.rank, tag, communicator_,
                        &under_way.emplace_back()),
              "MPI_Irecv");
  for (const Parcel& parcel : outgoing)
    check_mpi(MPI_Isend(parcel.values.data(), count(parcel.values), MPI_DOUBLE, parcel.rank, tag, communicator_,
                        &under_way.emplace_back()),
              "MPI_Isend");
  check_mpi(MPI_Waitall(static_cast<int>(under_way.size()), under_way.data(), MPI_STATUSES_IGNORE), "MPI_Waitall");
}

std::string MpiTeam::text_of(int rank, const std::string& text) {
  std::string result = text;
  int length = static_cast<int>(result.size());
  check_mpi(MPI_Bcast(&length, 1, MPI_INT, rank, communicator_), "MPI_Bcast");
  result.resize(static_cast<std::size_t>(length));
  check_mpi(MPI_Bcast(result.data(), length, MPI_CHAR, rank, communicator_), "MPI_Bcast");
  return result;
}

}  // namespace tether::protocol
