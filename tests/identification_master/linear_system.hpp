#pragma once

#include <Eigen/Dense>

#include <random>

#include "common/base/types.hpp"

namespace tether::testing {

inline MatrixXd random_matrix(std::mt19937& random, Eigen::Index rows, Eigen::Index columns) {
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

/// x <- A x + B theta + b, seen as H x + K theta with independent errors of unit variance over `precision`.
struct LinearSystem {
  MatrixXd A, B, H, K;
  VectorXd b, precision;

  LinearSystem(std::mt19937& random, int states, int parameters, int data)
      : A(damped(random_matrix(random, states, states))),
        B(random_matrix(random, states, parameters)),
        H(random_matrix(random, data, states)),
        K(random_matrix(random, data, parameters)),
        b(random_matrix(random, states, 1)),
        precision(random_matrix(random, data, 1).cwiseAbs().array() + 0.1) {}

  static MatrixXd damped(const MatrixXd& M) { return 0.95 * M / M.operatorNorm(); }
  VectorXd step(const VectorXd& x, const VectorXd& theta) const { return A * x + B * theta + b; }
  VectorXd seen(const VectorXd& x, const VectorXd& theta) const { return H * x + K * theta; }
};

/// The Kalman filter of (x, theta) with theta constant, by its textbook formulas.
struct KalmanFilter {
  const LinearSystem& system;
  VectorXd mean;  ///< x, then theta
  MatrixXd covariance;
  double chi_square = 0;

  KalmanFilter(const LinearSystem& system, const VectorXd& x, const VectorXd& theta, const MatrixXd& of_theta)
      : system(system), mean(x.size() + theta.size()), covariance(MatrixXd::Zero(mean.size(), mean.size())) {
    mean << x, theta;
    covariance.bottomRightCorner(theta.size(), theta.size()) = of_theta;
  }
  void predict() {
    const Eigen::Index n = system.A.rows(), p = system.B.cols();
    MatrixXd F = MatrixXd::Identity(n + p, n + p);
    F.topLeftCorner(n, n) = system.A;
    F.topRightCorner(n, p) = system.B;
    mean = (F * mean).eval();
    mean.head(n) += system.b;
    covariance = (F * covariance * F.transpose()).eval();
  }
  void correct(const VectorXd& data) {
    MatrixXd J(data.size(), mean.size());
    J << system.H, system.K;
    const VectorXd innovation = data - J * mean;
    const MatrixXd S = J * covariance * J.transpose() + MatrixXd(system.precision.cwiseInverse().asDiagonal());
    const MatrixXd gain = S.ldlt().solve(J * covariance).transpose(),
                   left = MatrixXd::Identity(mean.size(), mean.size()) - gain * J;
    chi_square = innovation.dot(S.ldlt().solve(innovation));
    mean += gain * innovation;
    covariance =
        (left * covariance * left.transpose() + gain * system.precision.cwiseInverse().asDiagonal() * gain.transpose())
            .eval();  // Joseph's form
  }
};

}  // namespace tether::testing
