#include "vessel/model/ready_case.hpp"

#include <cmath>
#include <numbers>

#include "common/mesh/surface.hpp"

namespace tether {

namespace {

constexpr double beat = 0.9, systole = 0.3;                    // s
constexpr double mean_velocity = 0.11;                         // m/s
constexpr double mean_pressure = 93, diastolic_pressure = 75;  // mmHg
constexpr double discharge_time = 1.5;                         // s
constexpr double proximal_share = 0.07;                        // of a Windkessel's resistance

/// [ml/s]
double mean_flow(const VesselModel& model, const UnitSystem& units) {
  const Patch& inlet = model.mesh.fluid.inlets.front();
  return area_of(model.mesh.fluid.points, inlet) * units.in_si(dimension::area) * mean_velocity * 1e6;
}

std::string outlets(const VesselModel& model, const UnitSystem& units) {
  const FluidMesh& fluid = model.mesh.fluid;
  double cubes = 0;
  for (const Patch& outlet : fluid.outlets) cubes += std::pow(area_of(fluid.points, outlet), 1.5);
  std::string text;
  for (const Patch& outlet : fluid.outlets) {
    const double share = std::pow(area_of(fluid.points, outlet), 1.5) / cubes;
    const double resistance = mean_pressure / (share * mean_flow(model, units));
    text += fmt::format(
        "    {}:                          # {:.1f} % of the flow\n"
        "      type: windkessel\n"
        "      proximal_resistance: {:.4g} mmHg s/ml\n"
        "      distal_resistance: {:.4g} mmHg s/ml\n"
        "      compliance: {:.4g} ml/mmHg\n"
        "      distal_pressure: {:g} mmHg\n",
        outlet.name, 100 * share, proximal_share * resistance, (1 - proximal_share) * resistance,
        discharge_time / resistance, -diastolic_pressure);
  }
  return text;
}

std::string supports(const WallMesh& wall, const UnitSystem& units) {
  std::string text;
  for (const Patch& region : wall.outside)
    text +=
        fmt::format("      {}: {{stiffness: {:.4g}, damping: {:.4g}}}\n", region.name,
                    units.from_si(1e5, dimension::support_stiffness), units.from_si(2e4, dimension::support_damping));
  return text;
}

std::string rings(const WallMesh& wall) {
  std::string text;
  for (const Patch& ring : wall.rings) text += fmt::format("    {}: {{type: clamped}}\n", ring.name);
  return text;
}

}  // namespace

std::string ready_case(const std::string& name, const VesselModel& model, const std::string& mesh_section,
                       const UnitSystem& units) {
  return fmt::format(
      "# To begin from: flow, pressures, wall and support are an adult's, not this patient's.\n"
      "name: {}\n"
      "title: A vessel meshed from its surface\n"
      "units: {}\n\n"
      "time: {{step: 2e-3, end: {:g}}}\n\n"
      "image:\n"
      "  pressure: {:g} mmHg              # at which the surface was seen\n"
      "  wall: stress_free\n\n"
      "{}\n"
      "fluid:\n"
      "  density: {:.4g}\n"
      "  rheology: {{type: newtonian, viscosity: {:.4g}}}\n"
      "  inlets:\n"
      "    {}:\n"
      "      profile: parabolic\n"
      "      flow: {{file: flow.csv, time: time, value: flow, period: {:g}, ramp: 0.02}}\n"
      "  outlets:\n{}"
      "\nsolid:\n"
      "  density: {:.4g}\n"
      "  material: {{type: neo_hookean, young: {:.4g}, poisson: 0.45}}\n"
      "  support:\n"
      "    regions:\n{}"
      "  rings:\n{}"
      "\noutput: {{write_every: 20, checkpoint_every: 100}}\n",
      name, units.name(), beat, diastolic_pressure, mesh_section, units.from_si(1060, dimension::density),
      units.from_si(0.004, dimension::viscosity), model.mesh.fluid.inlets.front().name, beat, outlets(model, units),
      units.from_si(1200, dimension::density), units.from_si(4e5, dimension::pressure),
      supports(model.mesh.wall, units), rings(model.mesh.wall));
}

std::string ready_flow(const VesselModel& model, const UnitSystem& units) {
  const double peak = mean_flow(model, units) * beat / systole * std::numbers::pi / 2;
  std::string text = "time [s], flow [ml/s]\n";
  constexpr int rows = 90;
  for (int i = 0; i <= rows; ++i) {
    const double time = beat * i / rows;
    text +=
        fmt::format("{:g},{:.5g}\n", time, time < systole ? peak * std::sin(std::numbers::pi * time / systole) : 0.0);
  }
  return text;
}

}  // namespace tether
