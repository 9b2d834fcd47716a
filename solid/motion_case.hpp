#pragma once

#include "common/config/fields.hpp"
#include "common/mesh/mesh.hpp"
#include "solid/motions/rigid_motion.hpp"

namespace tether {

/// How the frame of a table lies in that of the model.
struct PlacementCase {
  Vec3 x_axis = Vec3::Constant(undefined), y_axis = x_axis;
  void declare(Fields& f);
  /// Its columns are the data's axes as the model sees them.
  Mat3 rotation() const;
};

/// A measured motion over time, from columns of a CSV file: that of the heart at the inlet ring.
struct MotionCase {
  std::filesystem::path file;
  std::string table = "displacement", clock = "time", follow = "rigid";
  std::string time = "time", x = "x", y = "y", z = "z", point = "point", unit;
  std::vector<std::string> turn{"turn_x", "turn_y", "turn_z"};
  std::optional<double> period;
  int harmonics = 0;
  std::optional<PlacementCase> placement;
  void declare(Fields& f);
  /// In the case's units. `moved`: what follows, as imaged at `points`. Throws InputError that names the file, and the
  /// line if it is one.
  RigidMotion load(const UnitSystem& units, const Patch& moved, const Points& points) const;
};

/// What was read, for a person: how far it goes, and what the fits leave.
std::string describe(const RigidMotion& motion, const MotionCase& given, const UnitSystem& units);

}  // namespace tether
