#include "fluid/openings.hpp"

namespace tether::fluid {

FlowInlet::FlowInlet(const EndFace& face, const InletSettings& settings)
    : inflow(inflows(), settings.effect), face_(&face), curve_(settings.curve), kind_(settings.profile) {}

Points FlowInlet::velocity(double time, double kinematic_viscosity) {
  if (!profile_ || (kind_ == Profile::womersley && kinematic_viscosity != profile_viscosity_)) {
    profile_.emplace(*face_, kind_, curve_, kinematic_viscosity);
    profile_viscosity_ = kinematic_viscosity;
  }
  return profile_->velocity(*face_, flow(time), inflow->curve_time(time), inflow->gain(time));
}

Opening::Opening(const EndFace& face, const EffectChoice& effect, const Curve& curve, bool is_inlet)
    : beyond(outlets(), effect), face_(&face), curve_(curve), is_inlet_(is_inlet) {}

}  // namespace tether::fluid
