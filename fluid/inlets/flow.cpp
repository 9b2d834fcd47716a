#include "fluid/inlets/inflow.hpp"

namespace tether::fluid {
namespace {

/// Q(t) = scale curve(t - shift). (F.12)
class PrescribedFlow : public Inflow {
 public:
  explicit PrescribedFlow(std::span<const double> v) : scale_(v[0]), shift_(v[1]) {}
  double gain() const override { return scale_; }
  double curve_time(double time) const override { return time - shift_; }

 private:
  double scale_, shift_;
};

const EffectDeclaration declaration{
    "flow",
    "a measured or chosen flow into the vessel",
    Place::inlet,
    {{"scale", "factor of the flow curve", dimension::none, range::any, 1.0, 1.0, Transform::linear, 0.1},
     {"shift", "delay of the flow curve", dimension::time, range::any, 0.0, 0.0, Transform::linear, 0.01}}};

}  // namespace

extern const Registered<Inflow> flow{declaration, [](std::span<const double> v) -> std::unique_ptr<Inflow> {
                                       return std::make_unique<PrescribedFlow>(v);
                                     }};

}  // namespace tether::fluid
