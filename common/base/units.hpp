#pragma once

#include <string>
#include <string_view>

namespace tether {

/// Exponents of mass, length and time: a pressure is {1, -1, -2}.
struct Dimension {
  int mass = 0, length = 0, time = 0;
  friend constexpr bool operator==(const Dimension&, const Dimension&) = default;
};

namespace dimension {
inline constexpr Dimension none{}, mass{1, 0, 0}, length{0, 1, 0}, time{0, 0, 1}, rate{0, 0, -1};
inline constexpr Dimension area{0, 2, 0}, volume{0, 3, 0}, velocity{0, 1, -1}, flow{0, 3, -1};
inline constexpr Dimension force{1, 1, -2}, pressure{1, -1, -2}, density{1, -3, 0}, viscosity{1, -1, -1};
inline constexpr Dimension resistance{1, -4, -1}, compliance{-1, 4, 2};
inline constexpr Dimension support_stiffness{1, -2, -2},
    support_damping{1, -2, -1};  // traction per displacement, per velocity
}  // namespace dimension

/// The three base units in which a case states all its numbers. The programs compute in them: nothing is converted on
/// the way.
class UnitSystem {
 public:
  static UnitSystem cgs();
  static UnitSystem si();
  static UnitSystem mm_g_s();
  /// "cgs", "SI" or "mm-g-s". Throws InputError.
  static UnitSystem named(std::string_view name);

  const std::string& name() const { return name_; }
  /// The size of this system's unit of `dimension` in SI: 0.1 for a cgs pressure.
  double in_si(Dimension dimension) const;
  /// A number in SI, in this system's unit.
  double from_si(double value, Dimension dimension) const { return value / in_si(dimension); }
  /// "g/(cm s2)"; "1" for a number without unit.
  std::string symbol(Dimension dimension) const;
  /// A number with or without a unit, in this system's units: "80 mmHg" is 106657.6 in cgs, "0.2" is 0.2.
  /// Throws InputError for an unknown unit or one of another dimension.
  double quantity(std::string_view text, Dimension dimension) const;

  double to_mm(double length) const;
  double to_mmhg(double pressure) const;
  double to_ml_per_s(double flow) const;

 private:
  UnitSystem(std::string name, const char* mass_symbol, double mass, const char* length_symbol, double length);
  std::string name_, mass_symbol_, length_symbol_;
  double mass_, length_;  // in kg and m; the unit of time is the second in all systems
};

}  // namespace tether
