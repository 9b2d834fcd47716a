#include "fluid/bicgstab.hpp"

#include <limits>

namespace tether {
namespace {

/// One number for each of the three right-hand sides.
using Three = Eigen::Array3d;

void multiply(const SparseMatrix& matrix, const Points& x, Points& result) {
  const int* start = matrix.outerIndexPtr();
  const int* column = matrix.innerIndexPtr();
  const double* value = matrix.valuePtr();
  for (Eigen::Index row = 0; row < x.cols(); ++row) {
    Vec3 sum = Vec3::Zero();
    for (int k = start[row]; k < start[row + 1]; ++k) sum += value[k] * x.col(column[k]);
    result.col(row) = sum;
  }
}

Three dot(const Points& a, const Points& b) {
  Three sum = Three::Zero();
  for (Eigen::Index i = 0; i < a.cols(); ++i) sum += a.col(i).array() * b.col(i).array();
  return sum;
}

/// numerator / denominator; 0 for a right-hand side that is done, or where the division means nothing.
Three ratio(const Three& numerator, const Three& denominator, const Eigen::Array3i& active) {
  Three result = Three::Zero();
  for (int c = 0; c < 3; ++c)
    if (active[c] && std::abs(denominator[c]) > std::numeric_limits<double>::min())
      result[c] = numerator[c] / denominator[c];
  return result;
}

}  // namespace

KrylovResult bicgstab(const SparseMatrix& matrix, const Ilu0& preconditioner, const Points& rhs, Points& x,
                      double tolerance, int max_iterations) {
  const double scale = rhs.norm(), target = tolerance * scale;
  const Eigen::Index n = rhs.cols();
  Points residual(3, n), v(3, n), t(3, n), z(3, n), y(3, n);
  multiply(matrix, x, residual);
  residual = rhs - residual;
  const Points shadow = residual;
  Points direction = residual;
  Three rho = dot(shadow, residual);
  Eigen::Array3i active = (rho.sqrt() > target).cast<int>();

  KrylovResult result;
  while (active.any() && result.iterations < max_iterations) {
    ++result.iterations;
    y = direction;
    preconditioner.solve_in_place(y);
    multiply(matrix, y, v);
    const Three alpha = ratio(rho, dot(shadow, v), active);
    residual.noalias() -= alpha.matrix().asDiagonal() * v;
    z = residual;
    preconditioner.solve_in_place(z);
    multiply(matrix, z, t);
    const Three omega = ratio(dot(t, residual), dot(t, t), active);
    Three rho_new = Three::Zero(), norm = Three::Zero();
    for (Eigen::Index i = 0; i < n; ++i) {
      x.col(i).array() += alpha * y.col(i).array() + omega * z.col(i).array();
      residual.col(i).array() -= omega * t.col(i).array();
      rho_new += shadow.col(i).array() * residual.col(i).array();
      norm += residual.col(i).array().square();
    }
    active = active * (norm.sqrt() > target).cast<int>();
    const Three beta = ratio(rho_new, rho, active) * ratio(alpha, omega, active);
    for (Eigen::Index i = 0; i < n; ++i)
      direction.col(i).array() = residual.col(i).array() + beta * (direction.col(i).array() - omega * v.col(i).array());
    rho = rho_new;
  }
  multiply(matrix, x, t);
  result.residual = scale > 0 ? std::sqrt((rhs - t).rowwise().squaredNorm().maxCoeff()) / scale : 0.0;
  result.converged = !active.any() && std::isfinite(result.residual);
  return result;
}

}  // namespace tether
