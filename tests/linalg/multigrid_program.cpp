/// Started by mpirun: solves a block of springs by multigrid, in the processes there are, and prints how far the
/// solution is from a direct one: for the matrix as it is, after it has changed a little, and much.
#include <fmt/format.h>
#include <mpi.h>

#include "common/linalg/cholesky.hpp"
#include "common/protocol/mpi_team.hpp"
#include "tests/linalg/block_of_springs.hpp"

namespace tether {
namespace {

using namespace block_of_springs;

void compare(Team& team) {
  constexpr int n = 12, all_are_too_many = 0;
  const Share share(team, owners(n, team.size()));
  const auto multigrid = laplacian_solver(share, all_are_too_many);
  for (const double hold : {1e-3, 1.1e-3, 5.0}) {
    const SparseMatrix whole = assembled(share.nodes(), 1, cubes(n), hold);
    const VectorXd rhs = some_load(whole.rows());
    Cholesky direct;
    direct.factor(whole);
    const VectorXd expected = direct.solve(rhs);
    multigrid->factor(assembled_here(share, n, 1, hold));
    VectorXd mine = VectorXd::Constant(rhs.size(), 1e9);  // of others' nodes it is not read
    for (const int node : share.own()) mine[node] = rhs[node];
    const VectorXd found = multigrid->solve(mine);
    const double error = team.sum((found - expected).norm() / expected.norm());
    if (team.rank() == 0) fmt::print("{}\n", error);
  }
}

}  // namespace
}  // namespace tether

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  {
    tether::protocol::MpiTeam team(MPI_COMM_WORLD);
    tether::compare(team);
  }
  MPI_Finalize();
}
