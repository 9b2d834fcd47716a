#pragma once

#include "common/base/error.hpp"
#include "tests/fakes/fake_interface.hpp"

namespace tether::fakes {

/// A mass, a damper and a spring at each interface node and direction, backward Euler:
///   m (V - u0)/dt + c V + k (y0 + dt V) = load,   y1 = y0 + dt V,   u1 = V.
struct FakeSolid {
  double mass = 1, damping = 2, stiffness = 50;
  bool has_tangent = true, has_operators = true, has_state = true, announces_twice = false, is_outside = false;
  protocol::Interface surface = tube();
  std::vector<double> y0, u0, v;  ///< start of the step; velocity of the last evaluation or iterate
  double dt = 0;

  FakeSolid() : y0(surface.points.size(), 0.0), u0(y0), v(y0) {}

  double tangent() const { return mass / dt + damping + stiffness * dt; }
  /// load - m (V - u0)/dt - c V - k (y0 + dt V)
  std::vector<double> residual(const std::vector<double>& load) const {
    if (load.size() != y0.size()) throw input_error("a load has {} entries instead of {}", load.size(), y0.size());
    std::vector<double> r(load);
    for (std::size_t i = 0; i < r.size(); ++i)
      r[i] -= mass * (v[i] - u0[i]) / dt + damping * v[i] + stiffness * (y0[i] + dt * v[i]);
    return r;
  }
  std::vector<double> displacement() const {
    std::vector<double> y(y0);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += dt * v[i];
    return y;
  }
  static std::vector<double> scaled(std::vector<double> x, double factor) {
    for (double& value : x) value *= factor;
    return x;
  }

  protocol::Hello hello() const {
    protocol::Hello hello;
    hello.program = "fake solid 1";
    hello.has_tangent = has_tangent;
    hello.has_operators = has_operators;
    hello.has_state = has_state;
    hello.state_size = static_cast<std::int64_t>(2 * y0.size());
    hello.unknowns = static_cast<std::int64_t>(y0.size());
    hello.parameters = {{"stiffness", "of every spring", "dyn/cm", "log2", stiffness, 0, 0, 1e9, 1}};
    if (is_outside) hello.parameters[0].lower = 2 * hello.parameters[0].value;
    if (announces_twice) hello.parameters.push_back(hello.parameters[0]);
    return hello;
  }

  protocol::Interface operator()(const protocol::GetInterface&) { return surface; }
  protocol::Ready operator()(const protocol::SetParameters& m) {
    for (const auto& name : m.names)
      if (name != "stiffness") throw input_error("the solid has no parameter {}", name);
    for (const double value : m.values) stiffness = value;
    return {};
  }
  protocol::State operator()(const protocol::GetState&) {
    protocol::State state{y0};
    state.values.insert(state.values.end(), u0.begin(), u0.end());
    return state;
  }
  protocol::Ready operator()(const protocol::SetState& m) {
    if (m.values.size() != 2 * y0.size()) throw input_error("a state has {} entries", m.values.size());
    const auto middle = m.values.begin() + static_cast<std::ptrdiff_t>(y0.size());
    y0.assign(m.values.begin(), middle);
    u0.assign(middle, m.values.end());
    return {};
  }
  protocol::Ready operator()(const protocol::BeginStep& m) {
    dt = m.dt;
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = (m.predicted.at(i) - y0[i]) / dt;
    return {};
  }
  protocol::StepReport operator()(const protocol::EndStep& m) {
    if (m.accepted) {
      y0 = displacement();
      u0 = v;
    }
    return {};
  }
  protocol::Ready operator()(const protocol::Write&) { return {}; }
  protocol::Ready operator()(const protocol::Stop&) { return {}; }
  protocol::Motion operator()(const protocol::SolidEvaluate& m) {
    v.assign(v.size(), 0.0);
    v = scaled(residual(m.load), 1 / tangent());
    return {displacement(), v};
  }
  protocol::Motion operator()(const protocol::SolidTangent& m) {
    if (!has_tangent) throw run_error("no tangent");
    const auto change = scaled(m.load_change, 1 / tangent());
    return {scaled(change, dt), change};
  }
  protocol::SolidResidualReply operator()(const protocol::SolidResidual& m) {
    for (std::size_t i = 0; i < m.correction.size(); ++i) v.at(i) += m.correction[i];
    return {residual(m.load), displacement(), v};
  }
  protocol::Unknowns operator()(const protocol::SolidProduct& m) { return {scaled(m.direction, tangent())}; }
  protocol::Unknowns operator()(const protocol::SolidPrecondition& m) { return {scaled(m.residual, 1 / tangent())}; }
};

}  // namespace tether::fakes
