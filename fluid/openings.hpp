#pragma once

#include <optional>
#include <string>

#include "common/base/configured.hpp"
#include "fluid/end_face.hpp"
#include "fluid/inlets/inflow.hpp"
#include "fluid/outlets/outlet.hpp"
#include "fluid/settings.hpp"

namespace tether::fluid {

/// An inlet through which the flow is given: the velocity is prescribed on its face.
class FlowInlet {
 public:
  FlowInlet(const EndFace& face, const InletSettings& settings);

  const EndFace& face() const { return *face_; }
  Configured<Inflow> inflow;

  /// Into the vessel, in space or through the face as it moves [volume/time].
  double flow(double time) const;
  /// At the face's nodes (local), in space; `mesh_velocity`: there, of the mesh. Its flux, relative to the face if the
  /// flow is given so, is -flow(time) to round-off.
  Points velocity(double time, double kinematic_viscosity, const Points& mesh_velocity);

 private:
  const EndFace* face_;
  Curve curve_;
  double period_, ramp_;
  Profile kind_;
  bool through_ring_;
  std::optional<InletProfile> profile_;  // made when first needed, and again when the viscosity has changed
  double profile_viscosity_ = 0;
};

/// An outlet, or an inlet with a given pressure: the velocity is free, the pressure one number on the whole face.
class Opening {
 public:
  Opening(const EndFace& face, const EffectChoice& effect, const Curve& curve, bool is_inlet);

  const EndFace& face() const { return *face_; }
  bool is_inlet() const { return is_inlet_; }
  Configured<Outlet> beyond;

  OutletInput input(double time, double dt, double stored) const { return {dt, stored, curve_(time)}; }

 private:
  const EndFace* face_;
  Curve curve_;
  bool is_inlet_;
};

}  // namespace tether::fluid
