#include "solid/list_effects.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "solid/supports/registry.hpp"
#include "solid/wall_effects/registry.hpp"

namespace tether {
namespace {

std::vector<const EffectDeclaration*> catalogue() {
  std::vector<const EffectDeclaration*> all = declarations(surface_effects());
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
                          const Band& band = {}) {
    all.push_back({path, type, part, variant_of(type), band});
  };
  for (const auto& [region, support] : solid.support.regions)
    add("solid.support.regions." + region, support.effect.type, region);
  for (const auto& [ring, support] : solid.rings) add("solid.rings." + ring, support.effect.type, ring);
  for (const auto& [name, effect] : solid.effects)
    add("solid.effects." + name, effect.effect.type, effect.region, effect.band);
  return all;
}

/// A ring that is held otherwise than by a clamp, or is free, cannot be loosened.
bool is_clamped(const std::string& ring, const SolidCase& solid) {
  return std::none_of(solid.rings.begin(), solid.rings.end(),
                      [&](const auto& entry) { return entry.first == ring && entry.second.effect.type != "clamped"; });
}

std::vector<std::string> parts_for(const EffectDeclaration& effect, const SolidCase& solid, const WallMesh& mesh) {
  if (effect.target == EffectTarget::whole) return {""};
  std::vector<std::string> parts;
  if (effect.place == Place::ring) {
    for (const Patch& ring : mesh.rings)
      if (is_clamped(ring.name, solid)) parts.push_back(ring.name);
    return parts;
  }
  for (const Patch& region : mesh.outside) parts.push_back(region.name);
  return parts;
}

constexpr std::array halves{Band{0, 0.5}, Band{0.5, 1}};

/// Parts of the wall that are divided into halves: regions, and of what may change along the vessel all of it.
std::vector<std::string> divided_for(const EffectDeclaration& effect, const WallMesh& mesh) {
  std::vector<std::string> parts;
  if (effect.target == EffectTarget::whole || effect.place == Place::ring) return parts;
  if (effect.changes_along) parts.push_back("");
  for (const Patch& region : mesh.outside)
    if (!effect.changes_along || mesh.outside.size() > 1) parts.push_back(region.name);
  return parts;
}

PossibleEffect possible_effect(const EffectDeclaration& effect, const std::string& part, const Band& band,
                               const UnitSystem& units) {
  PossibleEffect possible{effect.name, part, effect.meaning, effect.role, effect.generic, effect.variant_of, {},
                          {},          band};
  for (const Parameter& p : effect.parameters) {
    const bool switches = !std::isnan(p.absent), must_be_given = std::isnan(p.standard);
    if (switches) possible.amplitudes.push_back({p.name, p.meaning, units.symbol(p.dimension)});
    if (must_be_given) possible.required.push_back(p.name);
  }
  return possible;
}

}  // namespace

EffectsList list_effects(const SolidCase& solid, const WallMesh& mesh, const UnitSystem& units) {
  EffectsList list;
  list.present = present_in(solid);
  const auto add = [&](const EffectDeclaration& effect, const std::string& part, const Band& band) {
    const auto is_there = [&](const PresentEffect& p) {
      return p.type == effect.name && p.part == part && p.band == band;
    };
    if (std::none_of(list.present.begin(), list.present.end(), is_there))
      list.possible.push_back(possible_effect(effect, part, band, units));
  };
  for (const EffectDeclaration* effect : catalogue()) {
    for (const std::string& part : parts_for(*effect, solid, mesh)) add(*effect, part, {});
    if (mesh.rings.size() < 2) continue;  // there is no way along it
    for (const std::string& part : divided_for(*effect, mesh))
      for (const Band& half : halves) add(*effect, part, half);
  }
  return list;
}

}  // namespace tether
