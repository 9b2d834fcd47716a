#include "solid/list_effects.hpp"

#include <algorithm>

#include "solid/motions/registry.hpp"
#include "solid/supports/registry.hpp"
#include "solid/wall_effects/registry.hpp"
#include "vessel/regions.hpp"

namespace tether {
namespace {

std::vector<const EffectDeclaration*> catalogue() {
  std::vector<const EffectDeclaration*> all = declarations(surface_effects());
  all.push_back(&moving_tissue.declaration);  // other motions need a file, or are not of the beat
  for (const EffectDeclaration* effect : declarations(wall_effects())) all.push_back(effect);
  return all;
}

/// Of what is in no catalogue, such as an expression, empty.
std::string variant_of(const std::string& type) {
  for (const EffectDeclaration* effect : catalogue())
    if (effect->name == type) return effect->variant_of;
  return {};
}

std::vector<PresentEffect> present_in(const SolidCase& solid) {
  std::vector<PresentEffect> all;
  const auto add = [&all](const std::string& path, const std::string& type, const std::string& part,
                          const Extent& extent = {}) {
    all.push_back({path, type, part, variant_of(type), extent});
  };
  for (const auto& [region, support] : solid.support.regions)
    add("solid.support.regions." + region, support.effect.type, region);
  for (const auto& [ring, support] : solid.rings) add("solid.rings." + ring, support.effect.type, ring);
  for (const auto& [name, effect] : solid.effects)
    add("solid.effects." + name, effect.effect.type, effect.region, effect.extent);
  return all;
}

/// A ring that is held otherwise than by a clamp, or is free, cannot be loosened.
bool is_clamped(const std::string& ring, const SolidCase& solid) {
  return std::none_of(solid.rings.begin(), solid.rings.end(),
                      [&](const auto& entry) { return entry.first == ring && entry.second.effect.type != "clamped"; });
}

bool is_free(const std::string& ring, const SolidCase& solid) {
  return std::any_of(solid.rings.begin(), solid.rings.end(),
                     [&](const auto& entry) { return entry.first == ring && entry.second.effect.type == "free"; });
}

bool is_motion(const EffectDeclaration& effect) {
  return &effect == &moving_tissue.declaration;
}

/// What holds a ring, a clamp too, or a region may move.
std::vector<std::string> parts_that_are_held(const SolidCase& solid, const WallMesh& mesh) {
  std::vector<std::string> parts;
  for (const Patch& ring : mesh.rings)
    if (!is_free(ring.name, solid)) parts.push_back(ring.name);
  for (const auto& [region, support] : solid.support.regions) parts.push_back(region);
  return parts;
}

std::vector<std::string> parts_for(const EffectDeclaration& effect, const SolidCase& solid, const WallMesh& mesh) {
  if (effect.target == EffectTarget::whole) return {""};
  if (is_motion(effect)) return parts_that_are_held(solid, mesh);
  std::vector<std::string> parts;
  if (effect.place == Place::ring) {
    for (const Patch& ring : mesh.rings)
      if (is_clamped(ring.name, solid)) parts.push_back(ring.name);
    return parts;
  }
  for (const Patch& region : mesh.outside) parts.push_back(region.name);
  return parts;
}

/// The half toward the first ring, that toward the others, that between them, and what is nearer to each of a region's
/// neighbours.
std::vector<Extent> extents_in(const std::string& part, const WallMesh& mesh, const Neighbours& neighbours) {
  std::vector<Extent> parts;
  if (mesh.rings.size() >= 2) parts = {{0, 0.5}, {0.5, 1}, {0.25, 0.75}};
  if (const auto own = neighbours.find(part); own != neighbours.end() && own->second.size() >= 2)
    for (const std::string& neighbour : own->second) parts.push_back({0, 1, neighbour});
  return parts;
}

/// Parts of the wall that are divided: regions, and of what may change along the vessel all of it.
std::vector<std::string> divided_for(const EffectDeclaration& effect, const WallMesh& mesh) {
  std::vector<std::string> parts;
  if (effect.target == EffectTarget::whole || effect.place == Place::ring) return parts;
  if (effect.changes_along) parts.push_back("");
  for (const Patch& region : mesh.outside)
    if (!effect.changes_along || mesh.outside.size() > 1) parts.push_back(region.name);
  return parts;
}

}  // namespace

EffectsList list_effects(const SolidCase& solid, const WallMesh& mesh, const UnitSystem& units) {
  EffectsList list;
  list.present = present_in(solid);
  const auto add = [&](const EffectDeclaration& effect, const std::string& part, const Extent& extent) {
    const auto is_there = [&](const PresentEffect& p) {
      return p.type == effect.name && p.part == part && p.extent == extent;
    };
    if (std::any_of(list.present.begin(), list.present.end(), is_there)) return;
    PossibleEffect possible = possible_effect(effect, units);
    possible.part = part;
    possible.extent = extent;
    list.possible.push_back(std::move(possible));
  };
  const Neighbours neighbours = neighbours_of(mesh.outside);
  for (const EffectDeclaration* effect : catalogue()) {
    for (const std::string& part : parts_for(*effect, solid, mesh)) add(*effect, part, {});
    for (const std::string& part : divided_for(*effect, mesh))
      for (const Extent& extent : extents_in(part, mesh, neighbours)) add(*effect, part, extent);
  }
  return list;
}

}  // namespace tether
