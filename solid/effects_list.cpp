#include "solid/effects_list.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "solid/supports/registry.hpp"
#include "solid/wall_effects/registry.hpp"

namespace tether {
namespace {

using Json = nlohmann::ordered_json;

/// An effect of the case: where it stands, which one it is, the part of the wall that it acts on.
struct Present {
  std::string path, type, part;
};

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

std::vector<Present> present_in(const SolidCase& solid) {
  std::vector<Present> all;
  for (const auto& [region, support] : solid.support.regions)
    all.push_back({"solid.support.regions." + region, support.effect.type, region});
  for (const auto& [ring, support] : solid.rings) all.push_back({"solid.rings." + ring, support.effect.type, ring});
  for (const auto& [name, effect] : solid.effects)
    all.push_back({"solid.effects." + name, effect.effect.type, effect.region});
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

Json described(const EffectDeclaration& effect, const std::string& part, const UnitSystem& units) {
  Json parameters = Json::array(), required = Json::array();
  for (const Parameter& p : effect.parameters) {
    const bool switches = p.absent == p.absent;
    if (switches) parameters.push_back({{"name", p.name}, {"meaning", p.meaning}, {"unit", units.symbol(p.dimension)}});
    if (p.standard != p.standard) required.push_back(p.name);
  }
  return {{"type", effect.name},       {"part", part},
          {"meaning", effect.meaning}, {"role", std::string(name_of(effect.role))},
          {"generic", effect.generic}, {"variant_of", effect.variant_of},
          {"amplitudes", parameters},  {"required", required}};
}

}  // namespace

std::string list_effects(const SolidCase& solid, const WallMesh& mesh, const UnitSystem& units) {
  const std::vector<Present> present = present_in(solid);
  Json possible = Json::array(), there = Json::array();
  for (const EffectDeclaration* effect : catalogue())
    for (const std::string& part : parts_for(*effect, solid, mesh))
      if (std::none_of(present.begin(), present.end(),
                       [&](const Present& p) { return p.type == effect->name && p.part == part; }))
        possible.push_back(described(*effect, part, units));
  for (const Present& p : present)
    there.push_back({{"path", p.path}, {"type", p.type}, {"part", p.part}, {"variant_of", variant_of(p.type)}});
  return Json{{"possible", possible}, {"present", there}}.dump(2);
}

}  // namespace tether
