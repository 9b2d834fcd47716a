#include "solid/case.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/base/error.hpp"
#include "solid/lumen_regions.hpp"
#include "solid/materials/registry.hpp"
#include "solid/prestress.hpp"
#include "solid/rest.hpp"
#include "solid/supports/registry.hpp"
#include "solid/wall_share.hpp"

namespace tether {
namespace {

const EffectDeclaration clamped_ring{.name = "clamped",
                                     .meaning = "The ring does not move",
                                     .place = Place::ring,
                                     .parameters = {},
                                     .role = EffectRole::holds};
const EffectDeclaration driven_ring{.name = "driven",
                                    .meaning = "The ring moves as 'motion' says, whatever the forces",
                                    .place = Place::ring,
                                    .parameters = {},
                                    .role = EffectRole::holds};
const EffectDeclaration free_ring{.name = "free",
                                  .meaning = "Nothing holds the ring",
                                  .place = Place::ring,
                                  .parameters = {},
                                  .role = EffectRole::replaces};

const std::vector<const EffectDeclaration*>& ring_family() {
  static const std::vector<const EffectDeclaration*> family = [] {
    std::vector<const EffectDeclaration*> list = declarations(supports());
    list.insert(list.begin(), {&clamped_ring, &driven_ring, &free_ring});
    return list;
  }();
  return family;
}

template <class Section>
const Section* named(const Named<Section>& sections, const std::string& name) {
  for (const auto& [key, section] : sections)
    if (key == name) return &section;
  return nullptr;
}

/// Throws InputError if the case names a patch that the mesh does not have.
template <class Section>
void check_names(const Named<Section>& sections, const std::vector<Patch>& patches, const std::string& field,
                 const CaseFile& file) {
  std::string known;
  for (const Patch& patch : patches) known += (known.empty() ? "" : ", ") + patch.name;
  for (const auto& [name, section] : sections)
    if (std::none_of(patches.begin(), patches.end(), [&name = name](const Patch& p) { return p.name == name; }))
      throw input_error("{}: the wall has no such part; it has: {}", file.where(field + "." + name), known);
}

bool is_given(const RingCase& ring) {
  return ring.effect.type == clamped_ring.name || ring.effect.type == driven_ring.name;
}

/// Of rings that are clamped or driven.
std::vector<int> given_nodes(const SolidCase& solid, const WallMesh& mesh) {
  std::vector<int> nodes;
  for (const Patch& ring : mesh.rings) {
    const RingCase* chosen = named(solid.rings, ring.name);
    if (chosen != nullptr && !is_given(*chosen)) continue;
    if (is_loose(ring.name, solid.effects)) continue;
    const std::vector<int> more = nodes_of(ring.triangles);
    nodes.insert(nodes.end(), more.begin(), more.end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

TissueMotion motion_of(const MotionCase& given, const Patch& ring, const WallMesh& mesh, const CaseFile& file,
                       std::vector<std::string>& notices) {
  const RigidMotion motion = given.load(file.units(), ring, mesh.points);
  notices.push_back(fmt::format("ring {}: {}", ring.name, describe(motion, given, file.units())));
  return motion;
}

/// Rings whose motion is given: clamped ones, as long as nothing loosens them, rest.
std::vector<DrivenRing> given_rings(const SolidCase& solid, const WallMesh& mesh, const CaseFile& file,
                                    std::vector<std::string>& notices) {
  std::vector<DrivenRing> result;
  for (const Patch& ring : mesh.rings) {
    const RingCase* chosen = named(solid.rings, ring.name);
    if (chosen != nullptr && !is_given(*chosen)) continue;
    result.push_back({ring.name, nodes_of(ring.triangles), {}});
    if (chosen != nullptr && chosen->effect.type == driven_ring.name)
      result.back().anchor.motion = motion_of(*chosen->motion, ring, mesh, file, notices);
  }
  return result;
}

std::vector<SurfaceSupport> make_supports(const SolidCase& solid, const WallMesh& mesh, const CaseFile& file,
                                          std::vector<DrivenRing>& given, std::vector<std::string>& notices) {
  std::vector<SurfaceSupport> result;
  for (const Patch& region : mesh.outside)
    if (const SupportCase* chosen = named(solid.support.regions, region.name))
      result.emplace_back(region, Configured<Support>(supports(), chosen->effect.type, chosen->effect.values));
  for (const Patch& ring : mesh.rings) {
    const RingCase* chosen = named(solid.rings, ring.name);
    if (chosen == nullptr || is_given(*chosen) || chosen->effect.type == free_ring.name) continue;
    result.emplace_back(ring, Configured<Support>(supports(), chosen->effect.type, chosen->effect.values),
                        chosen->motion ? motion_of(*chosen->motion, ring, mesh, file, notices) : TissueMotion{});
  }
  add_surface_effects(solid.effects, mesh, file, result, given);
  return result;
}

Points stress_free_positions(const SolidCase& solid, const WallMesh& mesh, const std::vector<int>& clamped,
                             const CaseFile& file, Team& team) {
  const Configured<Material> material(materials(), solid.material.type, solid.material.values);
  StressFreeResult found = stress_free_configuration(mesh, *material, file.common().image.pressure,
                                                     unknowns_of(clamped), wall_share(mesh, team));
  const double pressure = file.units().to_mmhg(file.common().image.pressure);
  if (!found.converged)
    throw run_error(
        "{}: there is no stress-free shape for {:.4g} mmHg, or none that was found in {} iterations: up to {:.3g} mmHg "
        "there is one; beyond, {}. The wall is too soft for this pressure, or the lumen not round enough for a thin "
        "wall; 'image.wall: prestressed' needs no such shape",
        file.where("image.pressure"), pressure, found.iterations, found.reached * pressure, found.failure);
  return std::move(found.positions);
}

/// Gives the wall its initial stress, if the image asks for one.
RestState prestress(WallModel& wall, const ImageCase& image) {
  if (!image.loads_wall() || image.wall != "prestressed") return rest_of(wall, image, nullptr);
  const InitialStress initial = find_initial_stress(wall.mesh(), wall.material(), image.pressure, wall.share());
  wall.set_initial_stress(initial);
  return rest_of(wall, image, &initial);
}

bool nothing_holds(const std::vector<SurfaceSupport>& supports) {
  return std::all_of(supports.begin(), supports.end(), [](const SurfaceSupport& support) {
    return support.effect().declaration().place != Place::outer_wall || support.effect().is_absent();
  });
}

/// Gain of each interface node: the largest of the regions that its triangles lie in.
VectorXd observer_gain(const ObserverCase& observer, const WallMesh& mesh) {
  VectorXd of_region(static_cast<Eigen::Index>(mesh.outside.size())), gain = VectorXd::Zero(mesh.interface_nodes);
  for (std::size_t r = 0; r < mesh.outside.size(); ++r) {
    const ObserverCase::Region* own = named(observer.regions, mesh.outside[r].name);
    of_region[static_cast<Eigen::Index>(r)] = own != nullptr ? own->gain : observer.gain;
  }
  const std::vector<int> regions = regions_of_interface(mesh);
  for (std::size_t t = 0; t < mesh.interface.size(); ++t)
    for (int node : mesh.interface[t]) gain[node] = std::max(gain[node], of_region[regions[t]]);
  return gain;
}

}  // namespace

void SupportCase::declare(Fields& f) {
  static const auto family = declarations(supports());
  f.effect(effect, family, "how the tissue holds this region");
}

void RingCase::declare(Fields& f) {
  f.effect(effect, ring_family(), "how this end ring is held");
  f.when("type", effect.type, {"visco_elastic", "normal_visco_elastic", "driven"}, [&] {
    f.group("motion", motion, "motion of the ring, or of what it is tied to: the heart; absent: it rests");
    f.check(motion.has_value() || effect.type != driven_ring.name, "type", "needs a section 'motion'");
  });
}

void SupportsCase::declare(Fields& f) {
  f.choice(
      "area", area,
      {{"reference", "tractions act per area of the imaged wall"}, {"current", "per area at the start of each step"}},
      "area to which the supports' tractions refer");
  f.groups("regions", regions, "regions of the outer wall that are held; the others are free");
}

void SolidCase::declare(Fields& f) {
  static const auto laws = declarations(materials());
  f.number("density", density, dimension::density, range::positive, "density of the wall");
  f.choice("element", element,
           {{"prism", "solid-shell prism that does not lock"}, {"p1", "linear tetrahedron; it locks in bending"}},
           "finite element of the wall");
  struct Law {
    EffectCase& effect;
    void declare(Fields& fields) { fields.effect(effect, laws, "hyperelastic law"); }
  } law{material};
  f.group("material", law, "elasticity of the wall");
  f.number("viscosity", viscosity, dimension::viscosity, range::not_negative,
           "stress per rate of Green-Lagrange strain");
  f.number("theta", theta, dimension::none, {0.5, 1.0},
           "of the midpoint rule: 0.5 has order 2, 0.55 damps high frequencies");
  f.choice("integrator", integrator,
           {{"midpoint", "stress at the middle of the step"},
            {"energy_conserving", "discrete gradient: conserves energy exactly"}},
           "how a step evaluates the stress");
  f.check(integrator == "midpoint" || theta == 0.5, "theta", "must be 0.5 for the integrator energy_conserving");
  f.group("support", support, "tissue around the wall");
  f.groups("rings", rings, "end rings of the wall; clamped if not named");
  f.groups("effects", effects, "what else acts on the wall or is different in it, any number on the same region");
}

void check_against_mesh(const SolidCase& solid, const WallMesh& mesh, const CaseFile& file) {
  check_names(solid.support.regions, mesh.outside, "solid.support.regions", file);
  check_names(solid.rings, mesh.rings, "solid.rings", file);
  check_effects(solid.effects, mesh, file);
  check_names(file.common().observer.regions, mesh.outside, "observer.regions", file);
}

void check_motions(const SolidCase& solid, const WallMesh& mesh, const CaseFile& file) {
  std::vector<std::string> notices;
  std::vector<DrivenRing> given = given_rings(solid, mesh, file, notices);
  make_supports(solid, mesh, file, given, notices);
}

PreparedWall prepare_wall(const SolidCase& solid, WallMesh mesh, const CaseFile& file, Team& team) {
  check_against_mesh(solid, mesh, file);
  const WallSettings settings{.material = solid.material.type,
                              .material_values = solid.material.values,
                              .density = solid.density,
                              .viscosity = solid.viscosity,
                              .theta = solid.theta,
                              .conserve_energy = solid.integrator == "energy_conserving",
                              .support_on_current_area = solid.support.area == "current"};
  PreparedWall wall;
  const std::vector<int> clamped = given_nodes(solid, mesh);
  std::vector<DrivenRing> given = given_rings(solid, mesh, file, wall.notices);
  std::vector<SurfaceSupport> held = make_supports(solid, mesh, file, given, wall.notices);
  const ImageCase& image = file.common().image;
  const Points stress_free = image.loads_wall() && image.wall == "inflated"
                                 ? stress_free_positions(solid, mesh, clamped, file, team)
                                 : mesh.points;
  if (file.common().observer.is_on()) wall.observer_gain = observer_gain(file.common().observer, mesh);
  if (nothing_holds(held)) wall.notices.push_back("nothing holds the outer wall: no region has a support");
  std::vector<LocalEffect> local = local_effects(solid.effects, mesh);
  wall.model = std::make_unique<WallModel>(std::move(mesh), settings, stress_free, clamped, std::move(held),
                                           std::move(local), team);
  wall.model->drive(std::move(given));
  wall.rest = prestress(*wall.model, image);
  if (wall.rest.held) wall.notices.push_back(describe(*wall.rest.held));
  return wall;
}

}  // namespace tether
