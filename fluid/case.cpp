#include "fluid/case.hpp"

#include <algorithm>

#include "common/base/error.hpp"
#include "fluid/inlets/inflow.hpp"
#include "fluid/outlets/outlet.hpp"
#include "fluid/probe.hpp"
#include "fluid/rheologies/rheology.hpp"
#include "fluid/section.hpp"

namespace tether::fluid {
namespace {

/// The kinds of inlet: all inflows, and the prescribed pressure of the outlets' family.
const std::vector<const EffectDeclaration*>& inlet_family() {
  static const std::vector<const EffectDeclaration*> family = [] {
    std::vector<const EffectDeclaration*> list = declarations(inflows());
    list.push_back(&find_effect(outlets(), "pressure").declaration);
    return list;
  }();
  return family;
}

template <class Physics>
EffectChoice choice_of(const EffectCase& effect, std::span<const Registered<Physics>> registry) {
  EffectChoice choice{effect.type, {}};
  const auto& parameters = find_effect(registry, effect.type).declaration.parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) choice.values[parameters[i].name] = effect.values[i];
  return choice;
}

template <class Entry>
bool has_entry(const Named<Entry>& entries, const std::string& name) {
  return std::any_of(entries.begin(), entries.end(), [&](const auto& entry) { return entry.first == name; });
}

bool is_end(const std::string& name, const FluidMesh& mesh) {
  const auto has_name = [&](const Patch& patch) { return patch.name == name; };
  return std::any_of(mesh.inlets.begin(), mesh.inlets.end(), has_name) ||
         std::any_of(mesh.outlets.begin(), mesh.outlets.end(), has_name);
}

SectionPlane plane_of(const SectionCase& section) {
  SectionPlane plane{section.point, section.normal};
  if (section.radius) plane.radius = *section.radius;
  return plane;
}

template <class Entry>
void check_names(const Named<Entry>& sections, const std::vector<Patch>& patches, const std::string& field,
                 const CaseFile& file) {
  std::string known;
  for (const Patch& patch : patches) {
    known += (known.empty() ? "" : ", ") + patch.name;
    if (!has_entry(sections, patch.name))
      throw input_error("{}: nothing is said of \"{}\", which the mesh has", file.where(field), patch.name);
  }
  for (const auto& [name, section] : sections)
    if (std::none_of(patches.begin(), patches.end(), [&name = name](const Patch& p) { return p.name == name; }))
      throw input_error("{}: the fluid mesh has no such face; it has: {}", file.where(field + "." + name), known);
}

/// Probes, sections and the faces at the ends share the names of observables.
void check_probes(const FluidCase& fluid, const FluidMesh& mesh, const CaseFile& file) {
  for (const auto& [name, position] : fluid.probes) {
    const std::string where = file.where("fluid.probes." + name);
    if (is_end(name, mesh))
      throw input_error("{}: is the name of an inlet or outlet, which has a pressure of its own", where);
    try {
      place_probe(name, position, mesh);
    } catch (const InputError& error) {
      throw input_error("{}: {}", where, error.what());
    }
  }
}

void check_sections(const FluidCase& fluid, const FluidMesh& mesh, const CaseFile& file) {
  for (const auto& [name, section] : fluid.sections) {
    const std::string where = file.where("fluid.sections." + name);
    if (is_end(name, mesh))
      throw input_error("{}: is the name of an inlet or outlet, which has a flow and a pressure of its own", where);
    if (has_entry(fluid.probes, name)) throw input_error("{}: is the name of a probe too", where);
    try {
      place_section(name, plane_of(section), mesh);
    } catch (const InputError& error) {
      throw input_error("{}: {}", where, error.what());
    }
  }
}

/// The curve of a prescribed pressure; zero where none is.
Curve curve_of(const EffectCase& effect, const PressureCurveCase& pressure, const UnitSystem& units) {
  return effect.type == "pressure" ? pressure.load(units) : Curve::constant(0);
}

InletSettings settings_of(const InletCase& inlet, const UnitSystem& units) {
  if (inlet.effect.type == "pressure")
    return {choice_of(inlet.effect, outlets()), inlet.pressure.load(units), 0, 0, {}, false};
  return {choice_of(inlet.effect, inflows()), inlet.flow.load(units),
          inlet.flow.period.value_or(0),      inlet.flow.ramp,
          profile_named(inlet.profile),       inlet.flow_through == "ring"};
}

/// Adds a sentence if the table's last value is held until the run ends.
void note_if_held(const std::string& end, const CurveCase& curve, const CaseFile& file,
                  std::vector<std::string>& notices) {
  if (curve.file.empty() || curve.period) return;
  const double last = curve.table(file.units()).times.back(), run_end = file.common().time.end;
  if (last < run_end * (1 - 1e-9))
    notices.push_back(
        fmt::format("{}: {} ends at {:g} s, the run at {:g} s: its last value is held until then; does it "
                    "repeat (period)?",
                    end, curve.file.filename().string(), last, run_end));
}

}  // namespace

void InletCase::declare(Fields& f) {
  f.effect(effect, inlet_family(), "what is known at this inlet");
  f.when("type", effect.type, {"flow"}, [&] {
    f.choice("profile", profile,
             {{"flat", "one velocity, falling to zero at the rim"},
              {"parabolic", "the steady developed flow of the inlet's shape"},
              {"womersley", "the oscillating developed flow of each harmonic of the curve"}},
             "how the velocity is spread over the inlet");
    f.choice("flow_through", flow_through,
             {{"plane", "a plane that stays in space, as of a magnetic-resonance measurement"},
              {"ring",
               "the inlet as it moves, such as what the heart ejects; for a ring that is driven: with one that "
               "gives way no step would be stable"}},
             "through what the flow is given");
    f.group("flow", flow, "flow into the vessel over time");
    f.check(profile != "womersley" || flow.period, "profile", "womersley needs a flow with a period");
  });
  f.when("type", effect.type, {"pressure"},
         [&] { f.group("pressure", pressure, "pressure over time, relative to the image's"); });
}

void OutletCase::declare(Fields& f) {
  static const auto family = declarations(outlets());
  f.effect(effect, family, "what lies beyond this outlet");
  f.when("type", effect.type, {"pressure"},
         [&] { f.group("pressure", pressure, "pressure over time, relative to the image's"); });
}

void SectionCase::declare(Fields& f) {
  f.point("point", point, dimension::length, "a point of the section, in the imaged blood");
  f.direction("normal", normal, "direction across the section in which flow counts as positive");
  f.number("radius", radius, dimension::length, range::positive,
           "what lies farther from the point does not count; without it: the connected part of the plane's cut that "
           "holds the point");
}

void FluidCase::declare(Fields& f) {
  static const auto laws = declarations(rheologies());
  f.number("density", density, dimension::density, range::positive, "density of the blood");
  struct Law {
    EffectCase& effect;
    void declare(Fields& fields) { fields.effect(effect, laws, "how the blood resists shearing"); }
  } law{rheology};
  f.group("rheology", law, "viscosity of the blood");
  f.choice("mesh_motion", mesh_motion,
           {{"harmonic", "each component by a Laplacian weighted with 1/volume"},
            {"elastic",
             "as an elastic body, stiffness 1/volume: keeps volumes better in very large motions, with three times the "
             "memory"}},
           "how the inside of the fluid mesh follows the wall");
  f.number("backflow_stabilisation", backflow_stabilisation, dimension::none, {0, 1},
           "factor of the force that damps blood entering through an outlet; 0.5 removes all its energy");
  f.groups("inlets", inlets, "by the names of the mesh's inlets");
  f.groups("outlets", outlets, "by the names of the mesh's outlets");
  f.points("probes", probes, dimension::length,
           "named points in the imaged blood, moving with the mesh: the pressure there is recorded");
  f.groups("sections", sections,
           "named planes across the imaged blood, fixed in space: flow and mean pressure there are recorded");
}

void check_against_mesh(const FluidCase& fluid, const FluidMesh& mesh, const CaseFile& file) {
  check_names(fluid.inlets, mesh.inlets, "fluid.inlets", file);
  check_names(fluid.outlets, mesh.outlets, "fluid.outlets", file);
  check_probes(fluid, mesh, file);
  check_sections(fluid, mesh, file);
}

FluidSettings make_settings(const FluidCase& fluid, const CaseFile& file) {
  const ImageCase& image = file.common().image;
  FluidSettings settings;
  settings.blood.values = {{"density", fluid.density},
                           {"backflow_stabilisation", fluid.backflow_stabilisation},
                           {"wall_load_offset", image.loads_wall() ? image.pressure : 0.0}};
  settings.rheology = choice_of(fluid.rheology, rheologies());
  settings.mesh_motion = mesh_motion_named(fluid.mesh_motion);
  for (const auto& [name, inlet] : fluid.inlets) settings.inlets[name] = settings_of(inlet, file.units());
  for (const auto& [name, outlet] : fluid.outlets)
    settings.outlets[name] = {choice_of(outlet.effect, outlets()),
                              curve_of(outlet.effect, outlet.pressure, file.units())};
  settings.probes = fluid.probes;
  for (const auto& [name, section] : fluid.sections) settings.sections.emplace_back(name, plane_of(section));
  return settings;
}

std::vector<std::string> held_curves(const FluidCase& fluid, const CaseFile& file) {
  std::vector<std::string> notices;
  for (const auto& [name, inlet] : fluid.inlets) {
    note_if_held(name, inlet.flow, file, notices);
    note_if_held(name, inlet.pressure, file, notices);
  }
  for (const auto& [name, outlet] : fluid.outlets) note_if_held(name, outlet.pressure, file, notices);
  return notices;
}

}  // namespace tether::fluid
