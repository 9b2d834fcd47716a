#pragma once

#include "common/config/case_file.hpp"
#include "common/config/curve_case.hpp"
#include "common/mesh/mesh.hpp"
#include "fluid/settings.hpp"

namespace tether::fluid {

struct FlowCurveCase : CurveCase {
  FlowCurveCase() : CurveCase(dimension::flow) {}
};
struct PressureCurveCase : CurveCase {
  PressureCurveCase() : CurveCase(dimension::pressure) {}
};

/// An inlet: a flow spread by a profile, or a pressure.
struct InletCase {
  EffectCase effect{"flow", {}};
  std::string profile = "parabolic", flow_through = "plane";
  FlowCurveCase flow;
  PressureCurveCase pressure;
  void declare(Fields& f);
};

/// What lies beyond an outlet.
struct OutletCase {
  EffectCase effect;
  PressureCurveCase pressure;
  void declare(Fields& f);
};

/// A plane across the blood.
struct SectionCase {
  Vec3 point = Vec3::Constant(undefined), normal = Vec3::Constant(undefined);
  std::optional<double> radius;
  void declare(Fields& f);
};

/// The section `fluid` of a case file.
struct FluidCase {
  double density = undefined, backflow_stabilisation = 0.2;
  EffectCase rheology{"newtonian", {}};
  std::string mesh_motion = "harmonic";
  Named<InletCase> inlets;
  Named<OutletCase> outlets;
  Named<Vec3> probes;
  Named<SectionCase> sections;
  void declare(Fields& f);
};

/// Throws InputError for an inlet or outlet that the mesh does not have, or of which the case says nothing, for a
/// probe that is not in the blood, a section that does not cross it from wall to wall, and one name for two of these.
void check_against_mesh(const FluidCase& fluid, const FluidMesh& mesh, const CaseFile& file);

/// Reads the curves. The wall bears the image's pressure as well if the case says so. Throws InputError.
FluidSettings make_settings(const FluidCase& fluid, const CaseFile& file);

/// A sentence for each table of an inlet or outlet that ends before the run does and does not repeat.
std::vector<std::string> held_curves(const FluidCase& fluid, const CaseFile& file);

}  // namespace tether::fluid
