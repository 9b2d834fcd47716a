#include "fluid/outlets/outlet.hpp"

namespace tether::fluid {
namespace {

/// p = P_distal + R Q (F.9).
class Resistance : public Outlet {
 public:
  explicit Resistance(std::span<const double> v) : R_(v[0]), P_distal_(v[1]) {}
  double impedance(double) const override { return R_; }
  double known(const OutletInput&) const override { return P_distal_; }

 private:
  double R_, P_distal_;
};

const EffectDeclaration resistance_declaration{
    "resistance",
    "the vessels downstream as one resistance, without a reservoir",
    Place::outlet,
    {{"resistance", "pressure per flow", dimension::resistance, range::not_negative, undefined, 0.0, Transform::log,
      0.3, 2e8},
     {"distal_pressure", "pressure behind the resistance, relative to the reference pressure", dimension::pressure,
      range::any, 0.0, 0.0, Transform::linear, 1000.0}}};

}  // namespace

extern const Registered<Outlet> resistance{
    resistance_declaration,
    [](std::span<const double> v) -> std::unique_ptr<Outlet> { return std::make_unique<Resistance>(v); }};

}  // namespace tether::fluid
