#include "vessel/region_case.hpp"

#include <algorithm>
#include <fstream>
#include <map>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/base/write_error.hpp"

namespace tether {

namespace {

Points curve_of(const ObjectCase& given, const UnitSystem& units) {
  if (!given.point.empty()) return Vec3(given.point[0], given.point[1], given.point[2]);
  const CsvTable table(given.file);
  const auto column = [&](const char* name) { return table.quantities(name, units, dimension::length); };
  const std::vector<double> x = column("x"), y = column("y"), z = column("z");
  const std::vector<std::string> names =
      given.object.empty() ? std::vector<std::string>(x.size()) : table.names("object");
  std::vector<Vec3> places;
  for (std::size_t row = 0; row < x.size(); ++row)
    if (names[row] == given.object) places.emplace_back(x[row], y[row], z[row]);
  if (places.empty()) throw input_error("{}: has no object {}", given.file.string(), given.object);
  Points curve(3, static_cast<Eigen::Index>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) curve.col(static_cast<Eigen::Index>(i)) = places[i];
  return curve;
}

AngleAbout angle_of(const GeometricRegionCase& given, const std::string& line, const UnitSystem& units) {
  AngleAbout angle{line, given.angle[0], given.angle[1]};
  if (!given.angle_origin.empty())
    angle.direction = {given.angle_origin[0], given.angle_origin[1], given.angle_origin[2]};
  if (given.toward) angle.toward = curve_of(*given.toward, units);
  return angle;
}

RegionRule rule_of(const std::string& name, const GeometricRegionCase& given, const UnitSystem& units) {
  RegionRule rule;
  rule.name = name;
  rule.branches = given.branches;
  const std::string line = given.line.empty() && given.branches.size() == 1 ? given.branches.front() : given.line;
  if (!given.along.empty()) rule.along = AlongBranch{line, given.along[0], given.along[1]};
  if (!given.angle.empty()) rule.angle = angle_of(given, line, units);
  for (const auto& [object, near] : given.near) rule.near.push_back({curve_of(near.curve, units), near.within});
  for (const auto& [side, plane] : given.planes) rule.planes.push_back({plane.point, plane.normal});
  if (given.box) rule.box = InBox{given.box->low, given.box->high};
  return rule;
}

/// A part of a divided region may have the name of another one.
void require_own_names(const std::vector<RegionRule>& rules) {
  for (std::size_t i = 0; i < rules.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (rules[k].name == rules[i].name)
        throw input_error("{}: two regions would be called {}: the parts of a divided one have its name and a number",
                          rules[i].where, rules[i].name);
}

}  // namespace

void ObjectCase::declare(Fields& f) {
  f.numbers("point", point, {3, dimension::length, {}}, "coordinates");
  f.path("file", file, "CSV file with the columns x [mm], y [mm], z [mm]: a curve, point after point");
  f.text("object", object, "of a file with several: that of its column `object`");
  f.check(object.empty() || !file.empty(), "object", "is of a file");
  f.check(point.empty() != file.empty(), "point", "give either a point or a file");
}

void NearCase::declare(Fields& f) {
  curve.declare(f);
  f.number("within", within, dimension::length, range::positive,
           "the distance, along the wall's surface, from the nearest places of that point or curve");
}

void PlaneCase::declare(Fields& f) {
  f.point("point", point, dimension::length, "in the plane");
  f.direction("normal", normal, "points into the region");
}

void BoxCase::declare(Fields& f) {
  f.point("low", low, dimension::length, "corner with the smallest coordinates");
  f.point("high", high, dimension::length, "corner with the largest coordinates");
  f.check(!(low.array() >= high.array()).any(), "high", "must be larger than low in each coordinate");
}

void GeometricRegionCase::declare(Fields& f) {
  f.texts("branches", branches,
          "of the centreline: places less far outside one of these than outside any other (distance less radius)");
  f.text("line", line, "branch whose line `along` and `angle` refer to; default: that of `branches`, else the trunk");
  f.numbers("along", along, {2, dimension::length, range::not_negative},
            "from and to along that line, from its start; that of a side branch lies on its parent's line, inside it");
  f.numbers("angle", angle, {2, dimension::none, {-360, 360}},
            "from and to [degrees] about that line, right-handed about the flow; may pass through zero");
  f.numbers("angle_origin", angle_origin, {3, dimension::none, {}}, "direction of angle zero; default: x");
  f.group("toward", toward, "angle zero is where this lies, instead: \"toward the spine\"");
  f.groups("near", near, "points and curves, by any name, that the region is near to along the surface");
  f.groups("planes", planes, "planes, by any name, on whose side of the normal the region is");
  f.group("box", box, "along the axes");
  f.integer("divide", divide, {1, 1000}, "into parts of equal length along the line, NAME_1, NAME_2, ...");
  f.check(
      angle_origin.empty() || std::any_of(angle_origin.begin(), angle_origin.end(), [](double x) { return x != 0; }),
      "angle_origin", "must not be zero");
  const auto in_order = [](const std::vector<double>& range) { return range.size() != 2 || range[0] < range[1]; };
  f.check(in_order(along), "along", "must go from the smaller to the larger");
  f.check(angle.size() != 2 || angle[0] != angle[1], "angle", "must go from one angle to another");
  f.check(!toward || angle_origin.empty(), "toward", "give either angle_origin or toward");
  f.check(angle.size() == 2 || (!toward && angle_origin.empty()), "angle", "must be given with its origin");
}

std::vector<RegionRule> rules_of(const Named<GeometricRegionCase>& regions, const Anatomy* anatomy,
                                 const UnitSystem& units,
                                 const std::function<std::string(const std::string& name)>& where) {
  std::vector<RegionRule> rules;
  for (const auto& [name, given] : regions) {
    RegionRule rule = rule_of(name, given, units);
    rule.where = where(name);
    const bool needs_line = !rule.branches.empty() || rule.along || rule.angle || given.divide > 1;
    if (needs_line && !anatomy)
      throw input_error(
          "mesh.files.regions.{}: branches, along, angle and divide refer to the centreline: give "
          "mesh.files.centreline",
          name);
    if (given.divide == 1) {
      rules.push_back(rule);
      continue;
    }
    for (RegionRule& part : divided_along(rule, given.divide, *anatomy)) rules.push_back(std::move(part));
  }
  require_own_names(rules);
  return rules;
}

Named<GeometricRegionCase> with_objects_in(const std::filesystem::path& file, Named<GeometricRegionCase> regions,
                                           const UnitSystem& units) {
  std::vector<ObjectCase*> objects;
  for (auto& [name, region] : regions) {
    if (region.toward) objects.push_back(&*region.toward);
    for (auto& [object, near] : region.near) objects.push_back(&near.curve);
  }
  std::string rows;
  std::map<std::pair<std::filesystem::path, std::string>, std::string> names;
  for (ObjectCase* object : objects) {
    if (object->file.empty()) continue;
    const auto [known, is_new] = names.emplace(std::pair(object->file, object->object), "");
    if (is_new) {
      known->second = fmt::format("object_{}", names.size());
      const Points curve = curve_of(*object, units);
      for (const auto& x : curve.colwise()) rows += fmt::format("{}, {}, {}, {}\n", known->second, x[0], x[1], x[2]);
    }
    object->file = file, object->object = known->second;
  }
  if (rows.empty()) return regions;
  std::ofstream out(file);
  out << fmt::format("object, x [{0}], y [{0}], z [{0}]\n", units.symbol(dimension::length)) << rows;
  if (!out.flush()) throw write_error(file);
  return regions;
}

}  // namespace tether
