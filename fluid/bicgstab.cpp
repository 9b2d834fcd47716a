#include "fluid/bicgstab.hpp"

#include <limits>

namespace tether {
namespace {

/// One number for each of the three right-hand sides.
using Three = Eigen::Array3d;

/// The matrix on vectors of all unknowns. What several processes share goes through the same three functions.
struct WholeMatrix {
  const SparseMatrix& rows;
  void refresh(Points&) const {}
  void sum(std::span<double>) const {}
};

/// The own rows of a matrix on the unknowns that they refer to.
struct SharedMatrix {
  const SparseMatrix& rows;
  const OwnRows& shared;
  void refresh(Points& x) const { shared.refresh(x); }
  void sum(std::span<double> values) const { shared.team().sum(values); }
};

template <class Matrix>
void multiply(const Matrix& matrix, Points& x, Points& result) {
  matrix.refresh(x);
  const int* start = matrix.rows.outerIndexPtr();
  const int* column = matrix.rows.innerIndexPtr();
  const double* value = matrix.rows.valuePtr();
  for (Eigen::Index row = 0; row < result.cols(); ++row) {
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

template <class Matrix>
KrylovResult solve(const Matrix& matrix, const Ilu0& preconditioner, const Points& rhs, Points& x, double tolerance,
                   int max_iterations) {
  const auto sum = [&matrix](Three value) {
    matrix.sum({value.data(), 3});
    return value;
  };
  double scale = rhs.squaredNorm();
  matrix.sum({&scale, 1});
  scale = std::sqrt(scale);
  const double target = tolerance * scale;
  const Eigen::Index n = rhs.cols();
  Points residual(3, n), v(3, n), t(3, n), z(3, x.cols()), y(3, x.cols());
  multiply(matrix, x, residual);
  residual = rhs - residual;
  const Points shadow = residual;
  Points direction = residual;
  Three rho = sum(dot(shadow, residual));
  Eigen::Array3i active = (rho.sqrt() > target).cast<int>();

  KrylovResult result;
  while (active.any() && result.iterations < max_iterations) {
    ++result.iterations;
    y.leftCols(n) = direction;
    preconditioner.solve_in_place(y);
    multiply(matrix, y, v);
    const Three alpha = ratio(rho, sum(dot(shadow, v)), active);
    residual.noalias() -= alpha.matrix().asDiagonal() * v;
    z.leftCols(n) = residual;
    preconditioner.solve_in_place(z);
    multiply(matrix, z, t);
    Eigen::Array<double, 6, 1> dots;
    dots << dot(t, residual), dot(t, t);
    matrix.sum({dots.data(), 6});
    const Three omega = ratio(dots.head<3>(), dots.tail<3>(), active);
    Three rho_new = Three::Zero(), norm = Three::Zero();
    for (Eigen::Index i = 0; i < n; ++i) {
      x.col(i).array() += alpha * y.col(i).array() + omega * z.col(i).array();
      residual.col(i).array() -= omega * t.col(i).array();
      rho_new += shadow.col(i).array() * residual.col(i).array();
      norm += residual.col(i).array().square();
    }
    dots << rho_new, norm;
    matrix.sum({dots.data(), 6});
    rho_new = dots.head<3>();
    norm = dots.tail<3>();
    active = active * (norm.sqrt() > target).cast<int>();
    const Three beta = ratio(rho_new, rho, active) * ratio(alpha, omega, active);
    for (Eigen::Index i = 0; i < n; ++i)
      direction.col(i).array() = residual.col(i).array() + beta * (direction.col(i).array() - omega * v.col(i).array());
    rho = rho_new;
  }
  multiply(matrix, x, t);
  const Three left = sum(Three((rhs - t).rowwise().squaredNorm()));
  result.residual = scale > 0 ? std::sqrt(left.maxCoeff()) / scale : 0.0;
  result.converged = !active.any() && std::isfinite(result.residual);
  return result;
}

}  // namespace

KrylovResult bicgstab(const SparseMatrix& matrix, const Ilu0& preconditioner, const Points& rhs, Points& x,
                      double tolerance, int max_iterations) {
  return solve(WholeMatrix{matrix}, preconditioner, rhs, x, tolerance, max_iterations);
}

KrylovResult bicgstab(const OwnRows& shared, const Ilu0& preconditioner, const Points& rhs, Points& x, double tolerance,
                      int max_iterations) {
  return solve(SharedMatrix{shared.rows(), shared}, preconditioner, rhs, x, tolerance, max_iterations);
}

}  // namespace tether
