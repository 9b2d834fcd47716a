#pragma once

#include <functional>

#include "common/base/units.hpp"
#include "common/config/fields.hpp"
#include "vessel/anatomy/region_rule.hpp"

/// Regions of a wall by geometry, as a case or a study states them.
namespace tether {

/// A point, or a curve in a file.
struct ObjectCase {
  std::vector<double> point;
  std::filesystem::path file;
  std::string object;  ///< of several in the file; empty: the file is one
  void declare(Fields& f);
};

struct NearCase {
  ObjectCase curve;
  double within = undefined;
  void declare(Fields& f);
};

struct PlaneCase {
  Vec3 point = Vec3::Constant(undefined), normal = Vec3::Constant(undefined);
  void declare(Fields& f);
};

struct BoxCase {
  Vec3 low = Vec3::Constant(undefined), high = Vec3::Constant(undefined);
  void declare(Fields& f);
};

/// A region: all that is given must hold.
struct GeometricRegionCase {
  std::vector<std::string> branches;
  std::string line;
  std::vector<double> along, angle, angle_origin;
  std::optional<ObjectCase> toward;
  Named<NearCase> near;
  Named<PlaneCase> planes;
  std::optional<BoxCase> box;
  int divide = 1;
  void declare(Fields& f);
};

/// The rules of regions in their order; a divided one is several. Throws InputError for a file that is wrong, a branch
/// that does not exist, a region that needs a centreline where there is none.
/// where: that a region stands, by its name, for messages.
std::vector<RegionRule> rules_of(const Named<GeometricRegionCase>& regions, const Anatomy* anatomy,
                                 const UnitSystem& units,
                                 const std::function<std::string(const std::string& name)>& where);

/// Writes the curves of files into one, each under a name of its own, and returns the regions that find them there. No
/// file is written where none is named. Throws InputError for a file that is wrong, RunError if it cannot be written.
Named<GeometricRegionCase> with_objects_in(const std::filesystem::path& file, Named<GeometricRegionCase> regions,
                                           const UnitSystem& units);

}  // namespace tether
