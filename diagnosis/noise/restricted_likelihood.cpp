#include "diagnosis/noise/restricted_likelihood.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "common/linalg/symmetric_eigen.hpp"

namespace tether {
namespace {

using Index = Eigen::Index;

/// Columns whose part that others do not make is below this share of them say nothing new.
constexpr double nothing_new = 1e-6;

/// Orthonormal columns that span the same.
MatrixXd basis_of(const MatrixXd& columns) {
  if (columns.cols() == 0) return columns;
  const VectorXd size = columns.colwise().norm();
  const MatrixXd even = columns * size.cwiseMax(1e-300).cwiseInverse().asDiagonal();
  Eigen::ColPivHouseholderQR<MatrixXd> qr(even);
  qr.setThreshold(nothing_new);
  return qr.householderQ() * MatrixXd::Identity(columns.rows(), qr.rank());
}

/// The shared columns of all frames become a basis of what the free ones do not make.
Index make_shared_independent(std::vector<NoiseField>& fields) {
  Index rows = 0, columns = 0;
  for (const NoiseField& field : fields)
    for (const NoiseFrame& frame : field.frames) {
      rows += frame.values.size();
      columns = std::max(columns, frame.shared.cols());
    }
  MatrixXd all(rows, columns);
  if (columns == 0) return 0;
  Index row = 0;
  for (const NoiseField& field : fields)
    for (const NoiseFrame& frame : field.frames) {
      all.middleRows(row, frame.values.size()) = frame.shared - field.free * (field.free.transpose() * frame.shared);
      row += frame.values.size();
    }
  all = basis_of(all);
  row = 0;
  for (NoiseField& field : fields)
    for (NoiseFrame& frame : field.frames) {
      frame.shared = all.middleRows(row, frame.values.size());
      row += frame.values.size();
    }
  return all.cols();
}

MatrixXd correlation(const Points& places, CorrelationShape shape, double length) {
  MatrixXd all = MatrixXd::Identity(places.cols(), places.cols());
  for (Index j = 0; j < all.cols(); ++j)
    for (Index i = j + 1; i < all.rows(); ++i)
      all(i, j) = correlation_at((places.col(i) - places.col(j)).norm(), length, shape);
  return all;  // the lower triangle
}

double log_determinant(const Eigen::LLT<MatrixXd>& factor) {
  return 2 * factor.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

double correlation_at(double apart, double length, CorrelationShape shape) {
  const double r = apart / length;
  return shape == CorrelationShape::exponential ? std::exp(-r) : std::exp(-r * r / 2);
}

RestrictedLikelihood::RestrictedLikelihood(std::vector<NoiseField> fields) : fields_(std::move(fields)) {
  for (NoiseField& field : fields_) {
    field.free = basis_of(field.free);
    count_ += (field.places.cols() - field.free.cols()) * static_cast<Index>(field.frames.size());
  }
  shared_ = make_shared_independent(fields_);
  count_ -= shared_;
}

RestrictedLikelihood::Slice RestrictedLikelihood::slice(CorrelationShape shape, double length) const {
  Slice slice;
  slice.shared_ = shared_;
  for (const NoiseField& field : fields_) {
    const SymmetricEigen waves = symmetric_eigen(correlation(field.places, shape, length));
    const auto turn = waves.vectors.transpose();
    Slice::Turned turned{waves.values.cwiseMax(0), turn * field.free, {}};
    for (const NoiseFrame& frame : field.frames) {
      MatrixXd both(frame.values.size(), shared_ + 1);
      if (shared_ > 0) both.leftCols(shared_) = frame.shared;
      both.col(shared_) = frame.values;
      turned.frames.push_back(turn * both);
    }
    slice.fields_.push_back(std::move(turned));
  }
  return slice;
}

RestrictedSums RestrictedLikelihood::Slice::at(double nugget) const {
  RestrictedSums sums;
  MatrixXd left = MatrixXd::Zero(shared_ + 1, shared_ + 1);
  for (const Turned& field : fields_) {
    const VectorXd variance = (1 - nugget) * field.variances.array() + nugget, precision = variance.cwiseInverse();
    const MatrixXd weighted = precision.asDiagonal() * field.free;
    const Eigen::LLT<MatrixXd> of_free(field.free.transpose() * weighted);
    sums.log_determinant += static_cast<double>(field.frames.size()) *
                            (variance.array().log().sum() + (field.free.cols() > 0 ? log_determinant(of_free) : 0));
    for (const MatrixXd& frame : field.frames) {
      left += frame.transpose() * precision.asDiagonal() * frame;
      if (field.free.cols() == 0) continue;
      const MatrixXd made = weighted.transpose() * frame;
      left -= made.transpose() * of_free.solve(made);
    }
  }
  sums.squares = left(shared_, shared_);
  if (shared_ == 0) return sums;
  const Eigen::LLT<MatrixXd> of_shared(left.topLeftCorner(shared_, shared_));
  sums.log_determinant += log_determinant(of_shared);
  const VectorXd made = left.col(shared_).head(shared_);
  sums.squares -= made.dot(of_shared.solve(made));
  return sums;
}

double RestrictedLikelihood::log_likelihood(const RestrictedSums& sums, double deviation) const {
  return -0.5 * (2 * static_cast<double>(count_) * std::log(deviation) + sums.squares / (deviation * deviation) +
                 sums.log_determinant);  // (D.23)
}

double RestrictedLikelihood::log_likelihood(const RestrictedSums& sums) const {
  return log_likelihood(sums, std::sqrt(sums.squares / static_cast<double>(count_)));
}

}  // namespace tether
