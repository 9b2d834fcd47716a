#include "diagnosis/noise/noise_field.hpp"

#include <algorithm>
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

}  // namespace

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

MatrixXd offset_and_shift(const Points& normals) {
  MatrixXd columns(normals.cols(), 4);
  columns << VectorXd::Ones(normals.cols()), normals.transpose();
  return columns;
}

}  // namespace tether
