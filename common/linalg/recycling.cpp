#include "common/linalg/recycling.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "common/base/error.hpp"

namespace tether {
namespace {

constexpr Eigen::Index most_directions = 12;
constexpr double filter = 0.1;  ///< a column is dropped if less of it is new to those before it
constexpr double least = 0.05;  ///< of |(H - 1) q|: below, H is 1 for all that a solver would notice

/// A T is orthonormal; columns of A that depend on those before them are left out. `gram`: A'A.
MatrixXd orthonormalizing(const MatrixXd& gram) {
  MatrixXd T(gram.rows(), 0);
  for (Eigen::Index j = 0; j < gram.cols(); ++j) {
    VectorXd t = VectorXd::Unit(gram.rows(), j);
    for (int turn = 0; turn < 2; ++turn) t -= T * (T.transpose() * (gram * t));
    const double length = std::sqrt(std::max(0.0, t.dot(gram * t)));
    if (!(length > filter * std::sqrt(gram(j, j)))) continue;
    T.conservativeResize(Eigen::NoChange, T.cols() + 1);
    T.rightCols<1>() = t / length;
  }
  return T;
}

/// The right singular vectors of the largest singular values of A, as many as are worth it. `gram`: A'A.
MatrixXd leading(const MatrixXd& gram) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> squares(gram);  // ascending
  const Eigen::Index worth = (squares.eigenvalues().array() > least * least).count();
  return squares.eigenvectors().rightCols(std::min(worth, most_directions));
}

/// What is made of so many rows at once stays in the cache: the pages of whole matrices had to be cleared at each
/// solve, which took half of the master's time.
template <class Body>
void for_each_block(Eigen::Index rows, const Body& body) {
  constexpr Eigen::Index most = 512;
  for (Eigen::Index row = 0; row < rows; row += most) body(row, std::min(most, rows - row));
}

}  // namespace

void Recycling::begin(const VectorXd& residual) {
  if (Q_.rows() != residual.size()) forget();
  if (Q_.cols() == 0 || residual.isZero(0)) return;
  bool changed = false;
  for (Eigen::Index i = 0; i < residual.size(); ++i) {
    if (residual[i] != 0 || (D_.row(i).isZero(0) && Q_.row(i).isZero(0))) continue;
    D_.row(i).setZero();
    Q_.row(i).setZero();
    changed = true;
  }
  if (changed) prepare();
}

VectorXd Recycling::solved(const VectorXd& v) const {
  VectorXd shares(Q_.cols()), x = v;
  for (Eigen::Index j = 0; j < Q_.cols(); ++j) shares[j] = Q_.col(j).cast<double>().dot(v);
  shares = inverse_ * shares;
  for (Eigen::Index j = 0; j < Q_.cols(); ++j) x -= shares[j] * D_.col(j).cast<double>();  // (C.9)
  return x;
}

void Recycling::note(VectorXd x, VectorXd y) {
  x_.push_back(std::move(x));
  y_.push_back(std::move(y));
}

void Recycling::learn() {
  if (x_.empty()) return;
  const Eigen::Index size = x_.front().size(), columns = static_cast<Eigen::Index>(x_.size()) + Q_.cols();
  MatrixXd of_x = MatrixXd::Zero(columns, columns), of_y = of_x;
  for_each_block(size, [&](Eigen::Index row, Eigen::Index rows) {
    const auto [X, Y] = pairs(row, rows);
    of_x += X.transpose() * X;
    of_y += Y.transpose() * Y;
  });
  const MatrixXd T = orthonormalizing(of_x), V = T * leading(T.transpose() * of_y * T);
  Eigen::MatrixXf Q(size, V.cols()), D(size, V.cols());
  for_each_block(size, [&](Eigen::Index row, Eigen::Index rows) {
    const auto [X, Y] = pairs(row, rows);
    Q.middleRows(row, rows) = (X * V).cast<float>();
    D.middleRows(row, rows) = (Y * V).cast<float>();
  });
  x_.clear();
  y_.clear();
  if (!Q.allFinite() || !D.allFinite()) return forget();
  Q_ = std::move(Q);
  D_ = std::move(D);
  prepare();
}

/// Rows of X, the latest first and then what was known, and of (H - 1) X.
std::pair<MatrixXd, MatrixXd> Recycling::pairs(Eigen::Index row, Eigen::Index rows) const {
  const auto fresh = static_cast<Eigen::Index>(x_.size()), known = Q_.cols();
  MatrixXd X(rows, fresh + known), Y(rows, fresh + known);
  for (Eigen::Index j = 0; j < fresh; ++j) {
    const auto latest = static_cast<std::size_t>(fresh - 1 - j);
    X.col(j) = x_[latest].segment(row, rows);
    Y.col(j) = y_[latest].segment(row, rows) - X.col(j);
  }
  if (known > 0) {
    X.rightCols(known) = Q_.middleRows(row, rows).cast<double>();
    Y.rightCols(known) = D_.middleRows(row, rows).cast<double>();
  }
  return {std::move(X), std::move(Y)};
}

void Recycling::prepare() {
  inverse_ = MatrixXd::Identity(Q_.cols(), Q_.cols());
  for_each_block(Q_.rows(), [this](Eigen::Index row, Eigen::Index rows) {
    inverse_ += Q_.middleRows(row, rows).cast<double>().transpose() * D_.middleRows(row, rows).cast<double>();
  });
  inverse_ = inverse_.inverse().eval();
  if (!inverse_.allFinite()) forget();
}

void Recycling::forget() {
  x_.clear();
  y_.clear();
  Q_.resize(0, 0);
  D_.resize(0, 0);
  inverse_.resize(0, 0);
}

std::vector<double> Recycling::packed() const {
  const auto half = static_cast<std::size_t>(Q_.size());
  std::vector<double> values(2 + half);
  values[0] = static_cast<double>(Q_.rows());
  values[1] = static_cast<double>(Q_.cols());
  if (half == 0) return values;
  std::memcpy(values.data() + 2, Q_.data(), half * sizeof(float));
  std::memcpy(reinterpret_cast<float*>(values.data() + 2) + half, D_.data(), half * sizeof(float));
  return values;
}

void Recycling::unpack(const double* begin, const double* end) {
  TETHER_ASSERT(end - begin >= 2, "packed directions have {} numbers", end - begin);
  const auto rows = static_cast<Eigen::Index>(begin[0]), columns = static_cast<Eigen::Index>(begin[1]);
  TETHER_ASSERT(end - begin == 2 + rows * columns, "{} numbers are no {} directions of {}", end - begin, columns, rows);
  const auto* numbers = reinterpret_cast<const float*>(begin + 2);
  forget();
  Q_ = Eigen::Map<const Eigen::MatrixXf>(numbers, rows, columns);
  D_ = Eigen::Map<const Eigen::MatrixXf>(numbers + rows * columns, rows, columns);
  prepare();
}

}  // namespace tether
