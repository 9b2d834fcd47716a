#pragma once

#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/units.hpp"

namespace tether {

inline constexpr double infinite = std::numeric_limits<double>::infinity();
inline constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

/// Allowed values of a number, ends included unless open.
struct Range {
  double lower = -infinite, upper = infinite;
  bool lower_open = false, upper_open = false;
  bool contains(double value) const {
    return (lower_open ? value > lower : value >= lower) && (upper_open ? value < upper : value <= upper);
  }
};
namespace range {
inline constexpr Range any{}, positive{0, infinite, true, false}, not_negative{0, infinite};
}

/// How a parameter is stretched to the real line when it is identified.
enum class Transform { linear, log, log2, bounded };

/// A number that an effect depends on: what the case file, --help, the manual and the identification need to know of
/// it.
struct Parameter {
  std::string name;     ///< words: "distal_resistance"
  std::string meaning;  ///< one sentence
  Dimension dimension;  ///< its unit follows from the case's unit system
  Range range;          ///< of admissible values
  double standard;      ///< value when the case file is silent, in SI; `undefined`: must be given
  double absent;        ///< value at which the effect does nothing; `undefined`: there is no such value
  Transform transform = Transform::linear;
  double prior_deviation = undefined;  ///< standard deviation after the transform, for identification; `linear`: in SI
  /// How far from `absent` the value of a patient may be, in SI: what a logarithm cannot say where `absent` is zero.
  /// `linear`: the prior deviation, unless it is given.
  double scale = undefined;
};

/// Where an effect acts.
enum class Place { wall, outer_wall, ring, interface, blood, inlet, outlet, data };

/// What an effect does to a model.
enum class EffectRole {
  holds,    ///< resists the wall's motion, passively
  loads,    ///< pushes, pulls or drives by itself
  replaces  ///< stands where the model has something else without it: a clamp, the wall's stiffness, another law
};

/// "holds".
constexpr std::string_view name_of(EffectRole role) {
  return role == EffectRole::holds ? "holds" : role == EffectRole::loads ? "loads" : "replaces";
}

/// How much of its place one effect acts on.
enum class EffectTarget {
  part,  ///< a region or ring that the case names
  whole  ///< all of it at once: the surroundings as such
};

/// One physical effect of a model: declared beside its code in one file, listed once in its family's registry.
struct EffectDeclaration {
  std::string name;     ///< as in the case file: "windkessel"
  std::string meaning;  ///< one sentence for a physician
  Place place;
  std::vector<Parameter> parameters;
  EffectRole role = EffectRole::replaces;
  EffectTarget target = EffectTarget::part;
  bool generic = false;         ///< says that something acts, not what: sought only where a case asks for it
  std::string variant_of = {};  ///< the effect that it is a special shape of: one for the other is no other verdict
  bool changes_along = false;   ///< it may differ from one half of the vessel to the other
};

/// An entry of a family's registry: `Physics` is the family's abstract class of point functions (a material, a support,
/// an outlet).
template <class Physics>
struct Registered {
  const EffectDeclaration& declaration;
  /// Values in the declaration's order, in the case's units.
  std::unique_ptr<Physics> (*make)(std::span<const double> values);
};

}  // namespace tether
