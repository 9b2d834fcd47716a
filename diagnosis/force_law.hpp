#pragma once

#include <string>
#include <vector>

#include "common/base/types.hpp"

/// The law that a force of unknown origin may follow. (D.14)
namespace tether {

/// What happens where the force acts, at the same moments: means over a region of the wall.
struct LocalMotion {
  VectorXd displacement;  ///< along the outward normal [length]
  VectorXd velocity;      ///< [length/time]
  VectorXd acceleration;  ///< [length/time^2]
  VectorXd pressure;      ///< of the blood beyond that of the image [pressure]
};

/// One term of a law. Its sign is that of a traction along the outward normal.
struct LawTerm {
  std::string name;                     ///< as a formula of a case has it: "un", "vn", "un*abs(un)"
  double coefficient = 0;               ///< [pressure over the term]
  double deviation = 0;                 ///< of the coefficient
  std::vector<std::string> alike = {};  ///< terms that would do as well in its place
};

struct ForceLaw {
  std::vector<LawTerm> terms;   ///< in the order in which they were taken in; none: nothing explains the force
  double explained = 0;         ///< share of the force's square that they explain
  bool is_expression = true;    ///< all terms can stand in a formula of a case: neither pressure nor acceleration
  std::string formula() const;  ///< "-1.2e+05*un - 3e+03*vn"
};

/// Chooses the terms that a force needs from 1, un, vn, acceleration, p, un |un|, un^3 and vn |vn|, one at a time, as
/// long as the BIC falls by 6. force, deviation: at the moments of `motion` [n]; deviations weight the moments, their
/// common size does not matter. correlated: how many neighbouring moments amount to one. (D.14)
ForceLaw law_of(const VectorXd& force, const VectorXd& deviation, const LocalMotion& motion, double correlated);

}  // namespace tether
