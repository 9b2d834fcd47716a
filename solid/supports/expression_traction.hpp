#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/base/configured.hpp"
#include "solid/supports/support.hpp"

namespace tether {

/// A traction on the outer wall as the case file writes it (S.21): what no registered effect says.
struct ExpressionLaw {
  std::string normal;               ///< along the outward normal; empty: none
  std::vector<std::string> vector;  ///< its x, y and z; empty: none
  std::vector<Parameter> parameters;
  double length = 1;  ///< a size of the wall [length]: differences are taken over a millionth of it
};

/// Names that an expression knows beside its parameters: x y z, nx ny nz, ux uy uz (displacement), vx vy vz (velocity),
/// their parts along the normal un and vn, and the time t.
const std::vector<std::string>& expression_names();

/// The effect, its parameters announced like those of any other. Throws InputError for what is no formula, for
/// one that is not zero where its parameters say that it is absent, or a parameter with the name of something else.
Configured<Support> configure(const ExpressionLaw& law, std::vector<double> values);

}  // namespace tether
