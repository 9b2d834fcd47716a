#include "common/base/units.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "common/base/error.hpp"

namespace tether {
namespace {

constexpr double pascal_per_mmhg = 133.322;

struct NamedUnit {
  std::string_view symbol;
  Dimension dimension;
  double in_si;
};

constexpr std::array named_units{
    NamedUnit{"m", dimension::length, 1.0},
    NamedUnit{"cm", dimension::length, 1e-2},
    NamedUnit{"mm", dimension::length, 1e-3},
    NamedUnit{"s", dimension::time, 1.0},
    NamedUnit{"ms", dimension::time, 1e-3},
    NamedUnit{"1/s", dimension::rate, 1.0},
    NamedUnit{"kg", dimension::mass, 1.0},
    NamedUnit{"g", dimension::mass, 1e-3},
    NamedUnit{"Pa", dimension::pressure, 1.0},
    NamedUnit{"kPa", dimension::pressure, 1e3},
    NamedUnit{"MPa", dimension::pressure, 1e6},
    NamedUnit{"mmHg", dimension::pressure, pascal_per_mmhg},
    NamedUnit{"dyn/cm2", dimension::pressure, 0.1},
    NamedUnit{"g/(cm s2)", dimension::pressure, 0.1},
    NamedUnit{"kg/m3", dimension::density, 1.0},
    NamedUnit{"g/cm3", dimension::density, 1e3},
    NamedUnit{"Pa s", dimension::viscosity, 1.0},
    NamedUnit{"mPa s", dimension::viscosity, 1e-3},
    NamedUnit{"P", dimension::viscosity, 0.1},
    NamedUnit{"g/(cm s)", dimension::viscosity, 0.1},
    NamedUnit{"m/s", dimension::velocity, 1.0},
    NamedUnit{"cm/s", dimension::velocity, 1e-2},
    NamedUnit{"mm/s", dimension::velocity, 1e-3},
    NamedUnit{"m3", dimension::volume, 1.0},
    NamedUnit{"cm3", dimension::volume, 1e-6},
    NamedUnit{"ml", dimension::volume, 1e-6},
    NamedUnit{"mm3", dimension::volume, 1e-9},
    NamedUnit{"N", dimension::force, 1.0},
    NamedUnit{"dyn", dimension::force, 1e-5},
    NamedUnit{"m3/s", dimension::flow, 1.0},
    NamedUnit{"cm3/s", dimension::flow, 1e-6},
    NamedUnit{"ml/s", dimension::flow, 1e-6},
    NamedUnit{"l/min", dimension::flow, 1e-3 / 60.0},
    NamedUnit{"L/min", dimension::flow, 1e-3 / 60.0},
    NamedUnit{"mmHg s/ml", dimension::resistance, pascal_per_mmhg * 1e6},
    NamedUnit{"dyn s/cm5", dimension::resistance, 1e5},
    NamedUnit{"g/(cm4 s)", dimension::resistance, 1e5},
    NamedUnit{"Pa s/m3", dimension::resistance, 1.0},
    NamedUnit{"ml/mmHg", dimension::compliance, 1e-6 / pascal_per_mmhg},
    NamedUnit{"cm5/dyn", dimension::compliance, 1e-5},
    NamedUnit{"cm4 s2/g", dimension::compliance, 1e-5},
    NamedUnit{"m3/Pa", dimension::compliance, 1.0},
    NamedUnit{"dyn/cm3", dimension::support_stiffness, 10.0},
    NamedUnit{"g/(cm2 s2)", dimension::support_stiffness, 10.0},
    NamedUnit{"kPa/mm", dimension::support_stiffness, 1e6},
    NamedUnit{"Pa/m", dimension::support_stiffness, 1.0},
    NamedUnit{"dyn s/cm3", dimension::support_damping, 10.0},
    NamedUnit{"g/(cm2 s)", dimension::support_damping, 10.0},
    NamedUnit{"Pa s/m", dimension::support_damping, 1.0},
};

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string expected(const std::string& unit) {
  return unit == "1" ? "has none" : "is in " + unit;
}

void append_power(std::string& text, const std::string& symbol, int power) {
  if (power == 0) return;
  if (!text.empty()) text += ' ';
  text += symbol;
  if (power != 1) text += std::to_string(power);
}

}  // namespace

UnitSystem::UnitSystem(std::string name, const char* mass_symbol, double mass, const char* length_symbol, double length)
    : name_(std::move(name)), mass_symbol_(mass_symbol), length_symbol_(length_symbol), mass_(mass), length_(length) {}

UnitSystem UnitSystem::cgs() {
  return {"cgs", "g", 1e-3, "cm", 1e-2};
}
UnitSystem UnitSystem::si() {
  return {"SI", "kg", 1.0, "m", 1.0};
}
UnitSystem UnitSystem::mm_g_s() {
  return {"mm-g-s", "g", 1e-3, "mm", 1e-3};
}

UnitSystem UnitSystem::named(std::string_view name) {
  for (const auto& system : {cgs(), si(), mm_g_s()})
    if (system.name() == name) return system;
  throw input_error("{}: unknown unit system; known are cgs, SI and mm-g-s", name);
}

double UnitSystem::in_si(Dimension d) const {
  return std::pow(mass_, d.mass) * std::pow(length_, d.length);
}

std::string UnitSystem::symbol(Dimension d) const {
  std::string above, below;
  append_power(above, mass_symbol_, std::max(d.mass, 0));
  append_power(above, length_symbol_, std::max(d.length, 0));
  append_power(above, "s", std::max(d.time, 0));
  append_power(below, mass_symbol_, std::max(-d.mass, 0));
  append_power(below, length_symbol_, std::max(-d.length, 0));
  append_power(below, "s", std::max(-d.time, 0));
  if (below.empty()) return above.empty() ? "1" : above;
  if (below.find(' ') != std::string::npos) below = "(" + below + ")";
  return (above.empty() ? "1" : above) + "/" + below;
}

double UnitSystem::quantity(std::string_view text, Dimension dimension) const {
  const std::string_view whole = trimmed(text);
  double number = 0.0;
  const char* begin = whole.data() + (whole.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, whole.data() + whole.size(), number);
  if (error != std::errc{} || whole.starts_with("+-")) throw input_error("'{}' is not a number", whole);
  const std::string_view unit = trimmed(whole.substr(static_cast<std::size_t>(end - whole.data())));
  if (unit.empty() || unit == symbol(dimension)) return number;
  for (const auto& known : named_units) {
    if (known.symbol != unit) continue;
    if (known.dimension != dimension)
      throw input_error("'{}': {} is no unit of this field, which {}", whole, unit, expected(symbol(dimension)));
    return number * known.in_si / in_si(dimension);
  }
  throw input_error("'{}': unknown unit '{}'; this field {}", whole, unit, expected(symbol(dimension)));
}

double UnitSystem::to_mm(double length) const {
  return length * in_si(dimension::length) * 1e3;
}
double UnitSystem::to_mmhg(double pressure) const {
  return pressure * in_si(dimension::pressure) / pascal_per_mmhg;
}
double UnitSystem::to_ml_per_s(double flow) const {
  return flow * in_si(dimension::flow) * 1e6;
}

}  // namespace tether
