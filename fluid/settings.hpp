#pragma once

#include <functional>
#include <limits>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/base/configured.hpp"
#include "common/base/curve.hpp"
#include "common/base/types.hpp"
#include "fluid/inlet_profile.hpp"
#include "fluid/mesh_motion.hpp"

namespace tether::fluid {

/// Numbers of the blood and of the scheme that are not an effect's. Their names, units and standards: `blood()`.
struct Blood {
  double density = 0;
  double backflow_stabilisation = 0;
  double wall_load_offset = 0;
};

/// Their declaration, in the form of a registry with one entry.
std::span<const Registered<Blood>> blood();

/// One inlet: a flow spread by a profile, or a pressure.
struct InletSettings {
  EffectChoice effect{"flow", {}};   ///< "flow", or "pressure": of the family of outlets
  Curve curve = Curve::constant(0);  ///< flow into the vessel [volume/time], or pressure
  double period = 0, ramp = 0;       ///< with which the curve was made, for Womersley's profile
  Profile profile = Profile::parabolic;
  bool through_ring = false;  ///< the flow is that through the face as it moves; else in space
};

struct OutletSettings {
  EffectChoice effect;
  Curve curve = Curve::constant(0);  ///< of a prescribed pressure; the other outlets have none
};

/// Where flow and mean pressure are reported: the plane's cut through the blood around the point.
struct SectionPlane {
  Vec3 point, normal;
  double radius = std::numeric_limits<double>::infinity();  ///< what lies farther from the point does not count
};

/// All that a case says about the fluid, the mesh aside. Pressures are relative to the case's reference pressure.
struct FluidSettings {
  EffectChoice blood{"blood", {}};
  EffectChoice rheology;
  MeshMotionKind mesh_motion = MeshMotionKind::harmonic;
  std::map<std::string, InletSettings> inlets;  ///< by the name of the mesh's face
  std::map<std::string, OutletSettings> outlets;
  /// Places of the reference mesh where the pressure is reported, by name.
  std::vector<std::pair<std::string, Vec3>> probes;
  /// Planes in the reference mesh, fixed in space, by name.
  std::vector<std::pair<std::string, SectionPlane>> sections;
  /// Force per mass at a point and time, such as gravity; empty: none.
  std::function<Vec3(const Vec3& x, double time)> body_acceleration;
  double linear_tolerance = 1e-9;  ///< of the advection-diffusion solve, relative
};

}  // namespace tether::fluid
