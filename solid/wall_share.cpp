#include "solid/wall_share.hpp"

namespace tether {
namespace {

template <std::size_t nodes>
std::vector<int> cut(const WallMesh& mesh, const std::vector<std::array<int, nodes>>& cells, int processes) {
  const auto count = static_cast<int>(mesh.points.cols());
  const ScatterMap graph(count, 1, std::span<const std::array<int, nodes>>(cells));
  return cut_graph(graph.zero_matrix(), std::vector<int>(static_cast<std::size_t>(count), 1), processes);
}

}  // namespace

Share wall_share(const WallMesh& mesh, Team& team) {
  if (team.is_alone()) return Share(static_cast<int>(mesh.points.cols()));
  return Share(team,
               mesh.prisms.empty() ? cut(mesh, mesh.tetrahedra, team.size()) : cut(mesh, mesh.prisms, team.size()));
}

double first_entry(const Share& share, const SparseMatrix& matrix) {
  return share.team().sum(share.is_own(0) ? matrix.coeff(0, 0) : 0.0);
}

}  // namespace tether
