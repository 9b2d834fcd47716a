#include "fluid/openings.hpp"

#include <cmath>

namespace tether::fluid {

FlowInlet::FlowInlet(const EndFace& face, const InletSettings& settings)
    : inflow(inflows(), settings.effect),
      face_(&face),
      curve_(settings.curve),
      period_(settings.period),
      ramp_(settings.ramp),
      kind_(settings.profile),
      through_ring_(settings.through_ring) {}

double FlowInlet::flow(double time) const {
  const double clock = inflow->curve_time(time);
  return inflow->gain() * curve_(clock) + onset(clock, ramp_) * inflow->added(time, period_);
}

Points FlowInlet::velocity(double time, double kinematic_viscosity, const Points& mesh_velocity) {
  if (!profile_ || (kind_ == Profile::womersley && kinematic_viscosity != profile_viscosity_)) {
    const double opened = period_ > 0 ? period_ * std::ceil(ramp_ / period_) : 0;  // a whole number of periods
    profile_.emplace(*face_, kind_, PeriodicCurve{curve_, period_, opened}, kinematic_viscosity);
    profile_viscosity_ = kinematic_viscosity;
  }
  const double clock = inflow->curve_time(time);
  Points result = profile_->velocity(*face_, flow(time), clock, inflow->gain() * onset(clock, ramp_));
  if (through_ring_) result += mesh_velocity;
  return result;
}

Opening::Opening(const EndFace& face, const EffectChoice& effect, const Curve& curve, bool is_inlet)
    : beyond(outlets(), effect), face_(&face), curve_(curve), is_inlet_(is_inlet) {}

}  // namespace tether::fluid
