#pragma once

#include <string>
#include <vector>

#include "common/base/effect.hpp"
#include "common/catalogue/extent.hpp"
#include "common/io/record.hpp"

namespace tether {

template <>
inline constexpr auto words_of<EffectRole> = std::to_array<WordOf<EffectRole>>(
    {{EffectRole::holds, "holds", "resists the wall's motion, passively"},
     {EffectRole::loads, "loads", "pushes, pulls or drives by itself"},
     {EffectRole::replaces, "replaces", "stands where the model has something else without it"}});

/// A number by which an effect is switched on.
struct OfferedAmplitude {
  static constexpr const char* type_name = "offered_amplitude";
  std::string name, meaning, unit;

  static void fields(auto& self, auto&& field) {
    field("name", self.name, "of the effect's parameter");
    field("meaning", self.meaning, "in words");
    field("unit", self.unit, "symbol");
  }
};

/// An effect of the catalogue on a part of the wall that the case does not have there.
struct PossibleEffect {
  static constexpr const char* type_name = "possible_effect";
  std::string type, part, meaning;
  EffectRole role = EffectRole::replaces;
  bool generic = false;
  std::string variant_of;
  std::vector<OfferedAmplitude> amplitudes;
  std::vector<std::string> required;
  Extent extent = {};
  std::string path;

  static void fields(auto& self, auto&& field) {
    field("type", self.type, "as in the case file");
    field("part", self.part, "region or ring; empty: the surroundings as such");
    field("meaning", self.meaning, "in words");
    field("role", self.role, "what it does to a model");
    field("generic", self.generic, "says that something acts, not what: sought only where a case asks for it");
    field("variant_of", self.variant_of, "the effect that it is a special shape of; empty: of none");
    field("amplitudes", self.amplitudes, "by which it is switched on");
    field("required", self.required, "parameters that must be given for it");
    field("from", self.extent.from, "where along the vessel the part begins, 0 at the first ring");
    field("to", self.extent.to, "where along the vessel the part ends, 1 at the other rings");
    field("toward", self.extent.toward, "of the region what is nearer to this neighbour than to others; empty: all");
    field("about", self.extent.about, "of that what lies within it; null: all");
    field("path", self.path, "of what it replaces in the case; empty: it is added to solid.effects");
  }
};

/// Of what its declaration says: what is left empty is the part.
PossibleEffect possible_effect(const EffectDeclaration& effect, const UnitSystem& units);

/// An effect that a case has.
struct PresentEffect {
  static constexpr const char* type_name = "present_effect";
  std::string path, type, part, variant_of;
  Extent extent = {};

  static void fields(auto& self, auto&& field) {
    field("path", self.path, "where it stands in the case");
    field("type", self.type, "as in the case file");
    field("part", self.part, "region or ring");
    field("variant_of", self.variant_of, "the effect that it is a special shape of; empty: of none");
    field("from", self.extent.from, "where along the vessel the part begins, 0 at the first ring");
    field("to", self.extent.to, "where along the vessel the part ends, 1 at the other rings");
    field("toward", self.extent.toward, "of the region what is nearer to this neighbour than to others; empty: all");
    field("about", self.extent.about, "of that what lies within it; null: all");
  }
};

/// What `solid --list-effects CASE.yaml` and `fluid --list-effects CASE.yaml` answer.
struct EffectsList {
  static constexpr const char* type_name = "effects_list";
  std::vector<PossibleEffect> possible;
  std::vector<PresentEffect> present;

  static void fields(auto& self, auto&& field) {
    field("possible", self.possible, "effects that the case does not have");
    field("present", self.present, "supports and effects that it has");
  }
};

}  // namespace tether
