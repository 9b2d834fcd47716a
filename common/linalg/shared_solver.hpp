#pragma once

#include "common/linalg/symmetric_solver.hpp"

namespace tether {

/// What the library with PETSc offers, beside the programs.
using MakeSharedSolver = SymmetricSolver*(const Share& share);
inline constexpr const char* shared_solver_file = "tether_petsc.so";
inline constexpr const char* shared_solver_function = "tether_make_shared_solver";

}  // namespace tether
