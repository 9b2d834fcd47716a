#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/io/record.hpp"

namespace tether {

/// What papers on a vessel report of it.
enum class Quantity {
  systolic_pressure,
  diastolic_pressure,
  strain,
  distensibility,
  pulse_wave_velocity,
  peak_flow,
  flow_share,
  peak_wall_stress,
  wall_shear,
  displacement
};

template <>
inline constexpr auto words_of<Quantity> = std::to_array<WordOf<Quantity>>({
    {Quantity::systolic_pressure, "systolic_pressure", "the largest at an inlet"},
    {Quantity::diastolic_pressure, "diastolic_pressure", "the smallest at an inlet"},
    {Quantity::strain, "strain",
     "largest over smallest volume of the lumen, less one: of its area, the length being fixed"},
    {Quantity::distensibility, "distensibility", "strain over the pulse pressure"},
    {Quantity::pulse_wave_velocity, "pulse_wave_velocity", "of Bramwell and Hill, from distensibility and density"},
    {Quantity::peak_flow, "peak_flow", "the largest out of an outlet"},
    {Quantity::flow_share, "flow_share", "of all that flows out in a beat, what leaves by an outlet"},
    {Quantity::peak_wall_stress, "peak_wall_stress",
     "the largest over the beat of what 99 % of the wall do not exceed, von Mises"},
    {Quantity::wall_shear, "wall_shear", "of the blood on the wall, mean over the lumen and the beat"},
    {Quantity::displacement, "displacement",
     "from the model as it is: root mean square over the lumen, at the measured moment of most"},
});

/// One of them in one model.
struct QuantityFound {
  static constexpr const char* type_name = "quantity_found";
  Quantity quantity = Quantity::strain;
  std::string where;
  double value = 0;
  std::optional<double> lower, upper;
  std::string unit;

  static void fields(auto& self, auto&& field) {
    field("quantity", self.quantity, "what it is");
    field("where", self.where, "its opening; empty: of the whole lumen");
    field("value", self.value, "in the last beat, in `unit`");
    field("lower", self.lower, "with the effects at the ends of their 95 % intervals; null: not known");
    field("upper", self.upper, "the same");
    field("unit", self.unit, "of the values; 1: none");
  }
};

/// Which model.
enum class ModelRole { as_it_is, accepted, rival };

template <>
inline constexpr auto words_of<ModelRole> = std::to_array<WordOf<ModelRole>>({
    {ModelRole::as_it_is, "as_it_is", "the case, with nothing added"},
    {ModelRole::accepted, "accepted", "with all that was accepted"},
    {ModelRole::rival, "rival", "with a rival of what was accepted in its place"},
});

/// What one model says of all of them.
struct PublishedQuantities {
  static constexpr const char* type_name = "published_quantities";
  ModelRole model = ModelRole::as_it_is;
  std::vector<std::string> effects;
  std::vector<QuantityFound> quantities;

  static void fields(auto& self, auto&& field) {
    field("model", self.model, "which it is");
    field("effects", self.effects, "that it has beside the case, in words");
    field("quantities", self.quantities, "of all models the same, in the same order");
  }
};

/// "pulse wave velocity [m/s]", "flow share of left [%]".
std::string name_of(const QuantityFound& quantity);
/// "5.21 (5.05 .. 5.43)", or the value alone.
std::string value_text(const QuantityFound& quantity);

}  // namespace tether
