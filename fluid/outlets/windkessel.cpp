#include "fluid/outlets/outlet.hpp"

namespace tether::fluid {
namespace {

/// Three elements: p = P + R_p Q, C dP/dt + (P - P_distal)/R_d = Q, by backward Euler (F.9):
///   Z = R_p + R_d / (1 + R_d C/dt),  known = (R_d C/dt P_0 + P_distal) / (1 + R_d C/dt).
/// Written without 1/R_d, so that R_d = 0 and C = 0 are fine.
class Windkessel : public Outlet {
 public:
  explicit Windkessel(std::span<const double> v) : R_p_(v[0]), R_d_(v[1]), C_(v[2]), initial_(v[3]), P_distal_(v[4]) {}

  double impedance(double dt) const override { return R_p_ + R_d_ / (1 + R_d_ * C_ / dt); }
  double known(const OutletInput& input) const override {
    const double s = R_d_ * C_ / input.dt;
    return (s * input.stored + P_distal_) / (1 + s);
  }
  bool stores() const override { return true; }
  double initial() const override { return initial_; }
  double advanced(const OutletInput& input, double flow) const override {
    return known(input) + R_d_ / (1 + R_d_ * C_ / input.dt) * flow;
  }

 private:
  double R_p_, R_d_, C_, initial_, P_distal_;
};

const EffectDeclaration windkessel_declaration{
    "windkessel",
    "the vessels downstream: a resistance, then an elastic reservoir that drains through a second resistance",
    Place::outlet,
    {{"proximal_resistance", "resistance before the reservoir", dimension::resistance, range::not_negative, undefined,
      0.0, Transform::log, 0.5, 1.5e7},
     {"distal_resistance", "resistance behind the reservoir", dimension::resistance, range::not_negative, undefined,
      0.0, Transform::log, 0.3, 2e8},
     {"compliance", "volume the reservoir takes up per pressure", dimension::compliance, range::not_negative, undefined,
      0.0, Transform::log, 0.5, 5e-9},
     {"initial_pressure", "pressure of the reservoir at the start, relative to the reference pressure",
      dimension::pressure, range::any, 0.0, undefined, Transform::linear, 1000.0},
     {"distal_pressure", "pressure behind the distal resistance, relative to the reference pressure",
      dimension::pressure, range::any, 0.0, 0.0, Transform::linear, 1000.0}}};

}  // namespace

extern const Registered<Outlet> windkessel{
    windkessel_declaration,
    [](std::span<const double> v) -> std::unique_ptr<Outlet> { return std::make_unique<Windkessel>(v); }};

}  // namespace tether::fluid
