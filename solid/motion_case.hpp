#pragma once

#include "common/config/fields.hpp"
#include "solid/motions/motion.hpp"

namespace tether {

/// A measured motion over time, from columns of a CSV file: that of the heart at the inlet ring.
struct MotionCase {
  std::filesystem::path file;
  std::string time = "time", x = "x", y = "y", z = "z";
  std::optional<double> period;
  void declare(Fields& f);
  /// In the case's units. Throws InputError "file:line: ...".
  TissueMotion load(const UnitSystem& units) const;
};

}  // namespace tether
