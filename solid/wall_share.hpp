#pragma once

#include "common/linalg/share.hpp"
#include "common/mesh/mesh.hpp"

namespace tether {

/// The nodes of a wall that each process of a team answers for.
Share wall_share(const WallMesh& mesh, Team& team);
/// The number in the matrix's first place, of whose row one process has it.
double first_entry(const Share& share, const SparseMatrix& matrix);

}  // namespace tether
