#include <cmath>
#include <numbers>

#include "fluid/inlets/inflow.hpp"

namespace tether::fluid {
namespace {

/// Q(t) = scale ramp(t) curve(t - shift); the ramp is half a cosine from 0 at t = 0 to 1 at t = ramp. (F.12)
class PrescribedFlow : public Inflow {
 public:
  explicit PrescribedFlow(std::span<const double> v) : scale_(v[0]), shift_(v[1]), ramp_(v[2]) {}
  double gain(double time) const override {
    return scale_ * (time >= ramp_ ? 1 : 0.5 * (1 - std::cos(std::numbers::pi * std::fmax(time, 0) / ramp_)));
  }
  double curve_time(double time) const override { return time - shift_; }

 private:
  double scale_, shift_, ramp_;
};

const EffectDeclaration declaration{
    "flow",
    "a measured or chosen flow into the vessel",
    Place::inlet,
    {{"scale", "factor of the flow curve", dimension::none, range::any, 1.0, 1.0, Transform::linear, 0.1},
     {"shift", "delay of the flow curve", dimension::time, range::any, 0.0, 0.0, Transform::linear, 0.01},
     {"ramp", "time over which the flow is opened smoothly from zero at the start", dimension::time, range::not_negative, 0.0, 0.0,
      Transform::linear, undefined}}};

}  // namespace

extern const Registered<Inflow> flow{
    declaration, [](std::span<const double> v) -> std::unique_ptr<Inflow> { return std::make_unique<PrescribedFlow>(v); }};

}  // namespace tether::fluid
