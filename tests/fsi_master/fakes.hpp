#pragma once

#include <Eigen/Dense>

#include <cmath>
#include <functional>

#include "fsi_master/partners.hpp"

/// A vessel of dense matrices with a known fixed point: a chain of masses and (hardening) springs, of which the first
/// `interface_nodes` are wetted by a fluid whose added mass is `ratio` times the chain's.
namespace tether::fake {

using Eigen::MatrixXd;

struct Vessel {
  int interface_nodes = 20, inner_nodes = 10;
  double ratio = 10;       ///< largest eigenvalue of the added mass over the wall's mass
  double stiffness = 400;  ///< of the springs between neighbours
  double hardening = 0;    ///< cubic spring of every node
  bool clamped = true;     ///< node 0 does not move

  int wet() const { return 3 * interface_nodes; }
  int all() const { return 3 * (interface_nodes + inner_nodes); }
  /// Second differences along the chain, one for each component.
  static MatrixXd chain(int size) {
    MatrixXd L = MatrixXd::Zero(size, size);
    for (int i = 0; i + 3 < size; ++i) {
      L(i, i) += 1, L(i + 3, i + 3) += 1;
      L(i, i + 3) -= 1, L(i + 3, i) -= 1;
    }
    return L;
  }
  MatrixXd stiffness_matrix() const { return stiffness * chain(all()) + 20 * MatrixXd::Identity(all(), all()); }
  /// Smooth motions move most blood: ratio (1 + 20 L)^-1.
  MatrixXd added_mass() const { return ratio * (MatrixXd::Identity(wet(), wet()) + 20 * chain(wet())).inverse(); }
};

/// What a test wants a partner to do wrong: called at the start of every step with (time, dt).
using Trouble = std::function<void(double, double)>;

class Fluid : public FluidPartner {
 public:
  explicit Fluid(const Vessel& vessel) : mass_(vessel.added_mass()), velocity_(VectorXd::Zero(vessel.wet())) {}
  Trouble trouble;
  bool tangent = true, with_state = true, answers_nan = false, refuses_the_end = false;
  int evaluations = 0, writes = 0;

  std::string name() const override { return "fake fluid"; }
  bool has_tangent() const override { return tangent; }
  bool has_state() const override { return with_state; }
  Later<Done> begin_step(const StepStart& start) override {
    start_ = start;
    if (trouble) trouble(start.time, start.dt);
    return Later<Done>(Done{});
  }
  Later<std::vector<double>> end_step(bool accepted) override {
    if (refuses_the_end)
      return Later<std::vector<double>>(std::function<std::vector<double>()>(
          []() -> std::vector<double> { throw StepFailure("no section is left"); }));
    if (accepted) velocity_ = candidate_;
    return Later<std::vector<double>>({velocity_.norm()});
  }
  Later<std::vector<double>> state() override {
    return Later<std::vector<double>>(std::vector<double>(velocity_.begin(), velocity_.end()));
  }
  Later<Done> set_state(std::vector<double> values) override {
    velocity_ = Eigen::Map<VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
    return Later<Done>(Done{});
  }
  Later<Done> write(std::int64_t, double) override { return ++writes, Later<Done>(Done{}); }
  Later<PartnerUsage> usage() override { return Later<PartnerUsage>({1.5, 20}); }

  /// A pressure that comes and goes, minus the blood's inertia.
  Later<VectorXd> load(const Motion& motion) override {
    ++evaluations;
    candidate_ = motion.velocity;
    const double pressure = 30 * std::sin(8 * (start_.time + start_.dt));
    const VectorXd shape = VectorXd::LinSpaced(motion.velocity.size(), 0.5, 1.5);
    VectorXd load = pressure * shape - mass_ * (motion.velocity - velocity_) / start_.dt;
    if (answers_nan) load(7) = std::nan("");
    return Later<VectorXd>(std::move(load));
  }
  Later<VectorXd> load_change(const VectorXd& dV) override { return Later<VectorXd>(-mass_ * dV / start_.dt); }

 private:
  MatrixXd mass_;
  VectorXd velocity_, candidate_;
  StepStart start_;
};

/// Backward Euler: (V - V_old)/dt + K (y0 + dt V) + h (y0 + dt V)^3 = R' load.
class Solid : public SolidPartner {
 public:
  explicit Solid(const Vessel& vessel)
      : vessel_(vessel), K_(vessel.stiffness_matrix()), y_(VectorXd::Zero(vessel.all())), velocity_(y_), V_(y_) {}
  bool operators = true, tangent = true, with_state = true;
  Trouble trouble;

  std::string name() const override { return "fake solid"; }
  bool has_tangent() const override { return tangent; }
  bool has_operators() const override { return operators; }
  bool has_state() const override { return with_state; }
  Later<Done> begin_step(const StepStart& start) override {
    dt_ = start.dt;
    V_ = velocity_;
    if (kept_.cols() == 0) kept_ = factor(tangent_matrix()).solve(MatrixXd::Identity(vessel_.all(), vessel_.all()));
    if (trouble) trouble(start.time, start.dt);
    return Later<Done>(Done{});
  }
  Later<std::vector<double>> end_step(bool accepted) override {
    if (accepted) {
      y_ += dt_ * V_;
      velocity_ = V_;
    }
    return Later<std::vector<double>>({y_.norm()});
  }
  Later<std::vector<double>> state() override {
    std::vector<double> values(y_.begin(), y_.end());
    values.insert(values.end(), velocity_.begin(), velocity_.end());
    values.insert(values.end(), kept_.data(), kept_.data() + kept_.size());
    return Later<std::vector<double>>(std::move(values));
  }
  Later<Done> set_state(std::vector<double> values) override {
    const int n = vessel_.all();
    y_ = Eigen::Map<VectorXd>(values.data(), n);
    velocity_ = Eigen::Map<VectorXd>(values.data() + n, n);
    kept_ = Eigen::Map<MatrixXd>(values.data() + 2 * n, n, n);
    return Later<Done>(Done{});
  }
  Later<Done> write(std::int64_t, double) override { return Later<Done>(Done{}); }
  Later<PartnerUsage> usage() override { return Later<PartnerUsage>({2.5, 30}); }

  Later<Motion> motion(const VectorXd& load) override {
    for (int i = 0; i < 50; ++i) {
      const VectorXd dV = factor(tangent_matrix()).solve(equation(load));
      V_ += dV;
      if (dV.norm() <= 1e-14 * V_.norm()) break;
    }
    return Later<Motion>(interface());
  }
  Later<VectorXd> velocity_change(const VectorXd& load_change) override {
    VectorXd all = VectorXd::Zero(vessel_.all());
    all.head(vessel_.wet()) = load_change;
    return Later<VectorXd>(factor(tangent_matrix()).solve(all).topRows(vessel_.wet()));
  }
  Later<Iterate> residual(const VectorXd& correction, const VectorXd& load) override {
    if (correction.size() > 0) V_ += correction;
    VectorXd r = equation(load);
    if (vessel_.clamped) r.head<3>().setConstant(1e3);  // reactions: numbers the master must not look at
    return Later<Iterate>({std::move(r), interface()});
  }
  Later<VectorXd> product(const VectorXd& direction) override { return Later<VectorXd>(tangent_matrix() * direction); }
  Later<VectorXd> precondition(const VectorXd& residual) override {
    VectorXd free = residual;
    if (vessel_.clamped) free.head<3>().setZero();
    return Later<VectorXd>(kept_ * free);
  }

 private:
  struct Factor {
    Eigen::LDLT<MatrixXd> ldlt;
    bool clamped;
    MatrixXd solve(MatrixXd b) const {
      if (clamped) b.topRows(3).setZero();
      return ldlt.solve(b);
    }
  };
  Factor factor(MatrixXd J) const {
    if (vessel_.clamped) {
      J.topRows(3).setZero();
      J.leftCols(3).setZero();
      J.topLeftCorner(3, 3).setIdentity();
    }
    return {Eigen::LDLT<MatrixXd>(J), vessel_.clamped};
  }
  MatrixXd tangent_matrix() const {
    const VectorXd y = y_ + dt_ * V_;
    MatrixXd J = dt_ * K_;
    J.diagonal().array() += 1 / dt_ + 3 * vessel_.hardening * dt_ * y.array().square();
    return J;
  }
  VectorXd equation(const VectorXd& load) const {
    const VectorXd y = y_ + dt_ * V_;
    VectorXd r = -(V_ - velocity_) / dt_ - K_ * y - vessel_.hardening * y.array().cube().matrix();
    r.head(vessel_.wet()) += load;
    return r;
  }
  Motion interface() const { return {(y_ + dt_ * V_).head(vessel_.wet()), V_.head(vessel_.wet())}; }

  Vessel vessel_;
  MatrixXd K_, kept_;
  VectorXd y_, velocity_, V_;
  double dt_ = 0;
};

}  // namespace tether::fake
