#include "diagnosis/noise/noise_field.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace tether {
namespace {

using Index = Eigen::Index;

std::vector<Index> drawn(Index from, Index count) {
  std::vector<Index> rows(static_cast<std::size_t>(from));
  std::iota(rows.begin(), rows.end(), 0);
  std::minstd_rand engine(1);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)  // not std::shuffle: the same with every library
    std::swap(rows[i], rows[i + engine() % (rows.size() - i)]);
  rows.resize(static_cast<std::size_t>(count));
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// The least deviation of the places from their middle in any direction: of a tube 0.7 radii.
double least_spread(const Points& places) {
  const Points apart = places.colwise() - places.rowwise().mean();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(apart * apart.transpose() / static_cast<double>(places.cols()));
  return std::sqrt(std::max(0.0, axes.eigenvalues()(0)));
}

}  // namespace

MatrixXd averaged(const Points& places, const MatrixXd& columns) {
  const double near = least_spread(places);
  if (near == 0) return columns;  // in a plane: a contour's are its own
  MatrixXd mean = columns;
  for (Index i = 0; i < places.cols(); ++i) {
    const VectorXd apart = (places.colwise() - places.col(i)).colwise().squaredNorm();
    const VectorXd weights = (-apart / (2 * near * near)).array().exp();
    mean.row(i) = weights.transpose() * columns / weights.sum();
  }
  return mean;
}

std::vector<NoiseField> thinned(std::vector<NoiseField> fields, Index most) {
  for (NoiseField& field : fields) {
    if (field.places.cols() <= most) continue;
    const std::vector<Index> rows = drawn(field.places.cols(), most);
    field.places = Points(field.places(Eigen::all, rows));
    field.free = MatrixXd(field.free(rows, Eigen::all));
    for (NoiseFrame& frame : field.frames) {
      frame.values = VectorXd(frame.values(rows));
      if (frame.shared.cols() > 0) frame.shared = MatrixXd(frame.shared(rows, Eigen::all));
    }
  }
  return fields;
}

MatrixXd offset_and_shift(const Points& places, const Points& normals) {
  MatrixXd columns(normals.cols(), 4);
  columns << VectorXd::Ones(normals.cols()), averaged(places, normals.transpose()).rowwise().normalized();
  return columns;
}

}  // namespace tether
