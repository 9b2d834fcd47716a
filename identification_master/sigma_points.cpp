#include "identification_master/sigma_points.hpp"

#include <cmath>

namespace tether {

MatrixXd simplex_points(int p) {
  MatrixXd points = MatrixXd::Zero(p, p + 1);
  const double beta = static_cast<double>(p) / (p + 1);
  for (int row = 0; row < p; ++row) {  // (K.2)
    const double s = std::sqrt(p / (beta * (row + 1) * (row + 2)));
    points.row(row).head(row + 1).setConstant(s);
    points(row, row + 1) = -(row + 1) * s;
  }
  return points;
}

}  // namespace tether
