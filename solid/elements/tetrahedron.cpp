#include "solid/elements/tetrahedron.hpp"

#include <Eigen/LU>

namespace tether {

TetrahedronElement::TetrahedronElement(const Positions& reference) {
  Mat3 edges;
  for (int i = 0; i < 3; ++i) edges.col(i) = reference.col(i + 1) - reference.col(0);
  volume_ = edges.determinant() / 6;
  const Mat3 inverse = edges.inverse();
  gradient_.bottomRows<3>() = inverse;
  gradient_.row(0) = -inverse.colwise().sum();
  constexpr int row[6] = {0, 1, 2, 0, 1, 0}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int k = 0; k < samples; ++k) {
    strains_.a.col(k) = gradient_.col(row[k]);
    strains_.b.col(k) = gradient_.col(column[k]);
    strains_.factor[k] = k < 3 ? 1 : 2;
  }
}

Eigen::Matrix<double, 4, 4> TetrahedronElement::mass() const {
  Eigen::Matrix<double, 4, 4> result = Eigen::Matrix<double, 4, 4>::Constant(volume_ / 20);
  result.diagonal().array() = volume_ / 10;
  return result;
}

}  // namespace tether
