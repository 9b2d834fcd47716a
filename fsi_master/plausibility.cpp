#include "fsi_master/plausibility.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace tether {
namespace {

/// What a number whose name ends so may be, in SI.
struct Usual {
  std::string_view ending;
  Dimension dimension;
  double least, most;
  const char *unit, *meaning;
};

const std::array usual{
    Usual{".density", dimension::density, 500, 2000, "kg/m3", "blood and tissue have about 1000"},
    Usual{".material.young", dimension::pressure, 1e4, 1e8, "Pa", "vessels have some 1e5 to 1e6"},
    Usual{".rheology.viscosity", dimension::viscosity, 5e-4, 5e-2, "Pa s", "blood has about 0.004"},
};

constexpr const char* question = "are the case's units right?";

}  // namespace

std::vector<std::string> unusual_numbers(const std::vector<protocol::ParameterInfo>& parameters,
                                         const UnitSystem& units) {
  std::vector<std::string> sentences;
  for (const auto& parameter : parameters)
    for (const Usual& u : usual) {
      const double value = parameter.value * units.in_si(u.dimension);
      if (parameter.name.ends_with(u.ending) && !(value >= u.least && value <= u.most))
        sentences.push_back(fmt::format("{} is {:.3g} {}; {}: {}", parameter.name, value, u.unit, u.meaning, question));
    }
  return sentences;
}

std::string unusual_image_pressure(double pressure, const UnitSystem& units) {
  const double mmhg = units.to_mmhg(pressure);
  if (pressure == 0 || (mmhg >= 10 && mmhg <= 300)) return "";
  return fmt::format("image.pressure is {:.3g} mmHg: {}", mmhg, question);
}

}  // namespace tether
