#include "fluid/outlets/outlet.hpp"

namespace tether::fluid {
namespace {

/// p = offset + scale curve(t), whatever the flow (F.9 with Z = 0).
class PrescribedPressure : public Outlet {
 public:
  explicit PrescribedPressure(std::span<const double> v) : offset_(v[0]), scale_(v[1]) {}
  double impedance(double) const override { return 0; }
  double known(const OutletInput& input) const override { return offset_ + scale_ * input.curve; }

 private:
  double offset_, scale_;
};

const EffectDeclaration pressure_declaration{
    "pressure",
    "a measured or chosen pressure",
    Place::outlet,
    {{"offset", "added to the curve", dimension::pressure, range::any, 0.0, 0.0, Transform::linear, 500.0},
     {"scale", "factor of the curve", dimension::none, range::any, 1.0, undefined, Transform::linear, 0.1}}};

}  // namespace

extern const Registered<Outlet> prescribed_pressure{
    pressure_declaration,
    [](std::span<const double> v) -> std::unique_ptr<Outlet> { return std::make_unique<PrescribedPressure>(v); }};

}  // namespace tether::fluid
