#pragma once

#include "common/linalg/krylov.hpp"
#include "common/linalg/own_rows.hpp"
#include "common/linalg/sparse.hpp"
#include "fluid/ilu.hpp"

namespace tether {

/// BiCGStab (van der Vorst 1992), preconditioned from the right by `preconditioner`, for three right-hand sides that
/// share the matrix: they advance side by side, so that the matrix and its factors are read once for all three. Column
/// i of rhs and x holds the three values of unknown i. Starts from x; a right-hand side is done when its residual's
/// norm is below tolerance * (norm of all of rhs). The result's residual is the largest of the three, relative to that
/// norm.
KrylovResult bicgstab(const SparseMatrix& matrix, const Ilu0& preconditioner, const Points& rhs, Points& x,
                      double tolerance, int max_iterations);
/// The same of a matrix whose rows several processes share. rhs: of the own rows; x: of all that these refer to.
/// preconditioner: of the own block.
KrylovResult bicgstab(const OwnRows& shared, const Ilu0& preconditioner, const Points& rhs, Points& x, double tolerance,
                      int max_iterations);

}  // namespace tether
