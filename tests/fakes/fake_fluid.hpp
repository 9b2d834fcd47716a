#pragma once

#include "common/base/error.hpp"
#include "tests/fakes/fake_interface.hpp"

namespace tether::fakes {

/// A fluid whose load is linear in the interface velocity: load = L0(t) - A V with
///   L0(t): `pressure` sin(2 t) along x on every node,   A: `added_mass` tridiag(-1, 2.5, -1) along the nodes, per
///   direction.
struct FakeFluid {
  double pressure = 3.0, added_mass = 0.5;
  bool has_tangent = true, has_state = true, has_velocity = false;
  double time = 0, new_time = 0;
  protocol::Interface surface = tube();

  std::size_t size() const { return surface.points.size(); }

  /// A V
  std::vector<double> inertia(const std::vector<double>& v) const {
    if (v.size() != size()) throw input_error("a velocity has {} entries instead of {}", v.size(), size());
    std::vector<double> result(v.size());
    for (std::size_t i = 0; i < v.size(); ++i)
      result[i] = added_mass * (2.5 * v[i] - (i >= 3 ? v[i - 3] : 0) - (i + 3 < v.size() ? v[i + 3] : 0));
    return result;
  }

  protocol::Hello hello() const {
    protocol::Hello hello;
    hello.program = "fake fluid 1";
    hello.has_tangent = has_tangent;
    hello.has_state = has_state;
    hello.has_velocity = has_velocity;
    hello.state_size = 1;
    hello.parameters = {{"pressure", "amplitude of the load", "dyn", "linear", pressure, 0, -1e3, 1e3, 1},
                        {"added_mass", "scale of A", "g/s", "log", added_mass, 0, 0, 1e3, 1}};
    hello.observables = {{"pressure.now", "dyn"}};
    return hello;
  }

  protocol::Interface operator()(const protocol::GetInterface&) { return surface; }
  protocol::Ready operator()(const protocol::SetParameters& m) {
    for (const auto& name : m.names)
      if (name != "pressure" && name != "added_mass") throw input_error("the fluid has no parameter {}", name);
    for (std::size_t i = 0; i < m.names.size(); ++i)
      (m.names[i] == "pressure" ? pressure : added_mass) = m.values.at(i);
    return {};
  }
  protocol::State operator()(const protocol::GetState&) { return {{time}}; }
  protocol::Ready operator()(const protocol::SetState& m) {
    return time = new_time = m.values.at(0), protocol::Ready{};
  }
  protocol::Ready operator()(const protocol::BeginStep& m) { return new_time = m.time + m.dt, protocol::Ready{}; }
  protocol::StepReport operator()(const protocol::EndStep& m) {
    (m.accepted ? time : new_time) = m.accepted ? new_time : time;
    return {{pressure * std::sin(2 * time)}};
  }
  protocol::Ready operator()(const protocol::Write&) { return {}; }
  protocol::Ready operator()(const protocol::Stop&) { return {}; }
  protocol::Load operator()(const protocol::FluidEvaluate& m) {
    auto load = inertia(m.velocity);
    for (std::size_t i = 0; i < load.size(); ++i)
      load[i] = (i % 3 == 0 ? pressure * std::sin(2 * new_time) : 0) - load[i];
    return {load};
  }
  protocol::Load operator()(const protocol::FluidTangent& m) {
    if (!has_tangent) throw run_error("no tangent");
    auto change = inertia(m.velocity_change);
    for (double& x : change) x = -x;
    return {change};
  }
};

}  // namespace tether::fakes
