/// Started by mpirun: solves a block of springs by multigrid, in the processes there are, and prints how far the
/// solution is from a direct one: for the matrix as it is, after it has changed a little, and much. Then, of a solver
/// that forgets, how far its next solution is from that of one that begins there.
#include <fmt/format.h>
#include <mpi.h>

#include "common/linalg/cholesky.hpp"
#include "common/protocol/mpi_team.hpp"
#include "tests/linalg/block_of_springs.hpp"

namespace tether {
namespace {

using namespace block_of_springs;

constexpr int n = 12, all_are_too_many = 0;

VectorXd solved(SymmetricSolver& solver, const Share& share, double hold) {
  solver.factor(assembled_here(share, n, 1, hold));
  const VectorXd rhs = some_load(share.nodes());
  VectorXd mine = VectorXd::Constant(rhs.size(), 1e9);  // of others' nodes it is not read
  for (const int node : share.own()) mine[node] = rhs[node];
  return solver.solve(mine);
}

void compare(Team& team) {
  const Share share(team, owners(n, team.size()));
  const auto tell = [&](const VectorXd& found, const VectorXd& expected) {
    const double error = team.sum((found - expected).norm() / expected.norm());
    if (team.rank() == 0) fmt::print("{}\n", error);
  };
  const auto multigrid = laplacian_solver(share, all_are_too_many);
  for (const double hold : {1e-3, 1.1e-3, 5.0}) {
    Cholesky direct;
    direct.factor(assembled(share.nodes(), 1, cubes(n), hold));
    tell(solved(*multigrid, share, hold), direct.solve(some_load(share.nodes())));
  }
  for (const bool forgets : {false, true}) {
    solved(*multigrid, share, 1e-3);
    if (forgets) multigrid->forget();
    tell(solved(*multigrid, share, 1.1e-3), solved(*laplacian_solver(share, all_are_too_many), share, 1.1e-3));
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
