#pragma once

#include <Eigen/Cholesky>

#include <random>

#include "identification_master/identification.hpp"
#include "observation_manager/measurements/surface_series.hpp"
#include "tests/observation_manager/lumens.hpp"

namespace tether::testing {

/// A tube that widens at its front by theta_0 s(t), at its rear by theta_1 s(t), linearly in between; s(t) = sin^2(pi
/// t/beat).
struct BreathingTube {
  static constexpr double beat = 0.8, length = 10, radius = 2;

  static double swing(double time) { return std::pow(std::sin(std::numbers::pi * time / beat), 2); }
  static double widening(double z, double front, double rear) { return front + (rear - front) * z / length; }
  /// Along z, of what flows in the widening tube, in a way: it falls to zero at the wall, and is none (NaN) behind it.
  static Points velocity(const Points& at, double time, double front, double rear) {
    Points all = Points::Zero(3, at.cols());
    for (Eigen::Index i = 0; i < at.cols(); ++i) {
      const double share = at.col(i).head<2>().norm() / radius;
      all(2, i) = share > 1 ? std::nan("") : swing(time) * widening(at(2, i), front, rear) * (1 - share * share);
    }
    return all;
  }
  /// Nodes on the tube.
  static TriangleSurface at(int around, int along, double time, double front, double rear) {
    return tube(around, along, length, [=](double z) { return radius + swing(time) * widening(z, front, rear); });
  }
  /// As it is measured: longer than the model, and with facets that are on the tube on average, not inside it.
  static TriangleSurface measured(int around, int along, double time, double front, double rear) {
    constexpr double beyond = 1;
    const double angle = std::numbers::pi / around;
    TriangleSurface surface = tube(around, along, length + 2 * beyond, [=](double z) {
      return (radius + swing(time) * widening(z - beyond, front, rear)) * angle / std::sin(angle);
    });
    surface.points.row(2).array() -= beyond;
    return surface;
  }
};

/// Errors along the normals, smooth as a segmentation is: alike as exp(-r^2/(2 l^2)), so that one in 2 pi l^2 is
/// independent, as of exp(-r/l).
class CorrelatedErrors {
 public:
  CorrelatedErrors(const Points& x, double deviation, double length, unsigned seed) : random_(seed) {
    MatrixXd C(x.cols(), x.cols());
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      C.col(i) = deviation * deviation *
                 (-(x.colwise() - x.col(i)).colwise().squaredNorm().array() / (2 * length * length))
                     .exp()
                     .matrix()
                     .transpose();
    C.diagonal().array() += 1e-8 * deviation * deviation;
    factor_ = C.llt().matrixL();
  }
  VectorXd draw() {
    std::normal_distribution<double> normal;
    return factor_ * VectorXd::NullaryExpr(factor_.rows(), [&] { return normal(random_); });
  }

 private:
  std::mt19937 random_;
  MatrixXd factor_;
};

/// Its model: particles without memory, whose lumen has a mesh of its own, against measured surfaces.
class BreathingEnsemble : public Ensemble {
 public:
  BreathingEnsemble(const Observations& data, int around, int along) : data_(data), around_(around), along_(along) {
    hello_.observables = {{"fluid.front", "cm"}};
  }
  Points lumen() const { return BreathingTube::at(around_, along_, 0, 0, 0).points; }

  const protocol::Hello& model() const override { return hello_; }
  VectorXd initial_state() override { return VectorXd::Zero(1); }
  std::vector<ParticleReport> advance(const EnsembleStep& step, const std::vector<NamedValues>& values,
                                      MatrixXd& states, std::vector<std::vector<double>>&) override {
    std::vector<ParticleReport> reports;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double end = step.time + step.dt, front = values[i].values[0], rear = values[i].values[1];
      states(0, static_cast<Eigen::Index>(i)) = BreathingTube::swing(end) * front;
      ParticleReport report;
      report.observables = {BreathingTube::swing(end) * front};
      const Points velocity = BreathingTube::velocity(data_.points(), end, front, rear);
      report.velocities.assign(velocity.data(), velocity.data() + velocity.size());
      if (step.observe)
        for (const Sample& sample : data_.observe(BreathingTube::at(around_, along_, end, front, rear).points, end)) {
          report.distances.push_back(sample.distance);
          report.weights.push_back(sample.weight);
        }
      reports.push_back(std::move(report));
    }
    return reports;
  }

 private:
  const Observations& data_;
  int around_, along_;
  protocol::Hello hello_;
};

}  // namespace tether::testing
