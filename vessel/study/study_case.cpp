#include "vessel/study/study_case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "common/base/error.hpp"
#include "common/base/name.hpp"
#include "common/config/case_tree.hpp"
#include "common/config/describe.hpp"
#include "common/config/reader.hpp"

namespace tether {

void SurfaceCase::declare(Fields& f) {
  f.path("file", file, ".stl, .vtp, .ply, .obj, .vtk or .msh, open or closed", Need::required);
  f.choice("unit", unit, {{"mm", "the file's coordinates are millimetres"}, {"cm", "centimetres"}, {"m", "metres"}},
           "of the file's coordinates");
  f.text("label_array", label_array, "the file's labels of triangles, if it has any");
  f.flag("any_size", any_size, "do not refuse openings that no vessel has, which mostly mean a wrong unit");
}

void LoftCase::declare(Fields& f) {
  ContoursCase::declare(f);
  f.group("extend", extend, "straight extension beyond the first and last contour, along the axis");
  f.flag("any_size", any_size, "do not refuse openings that no vessel has, which mostly mean a wrong unit");
}

void RepairCase::declare(Fields& f) {
  constexpr Range merging{1e-9, 100};  // cells of that size are counted in integers; no vessel is 1 m long
  f.number("merge", merge, dimension::length, merging, "points nearer to each other than this are one");
  f.number("sliver", sliver, dimension::length, range::positive, "edges of needles shorter than this are removed");
  f.number("largest_hole", largest_hole, dimension::length, range::not_negative,
           "radius up to which a rim that is no opening is filled");
  f.integer("smoothing", smoothing, {0, 1000}, "pairs of steps that smooth without shrinking; 0: none");
}

void CutPlaneCase::declare(Fields& f) {
  f.point("point", point, dimension::length, "on the plane, near the vessel's middle");
  f.direction("outward", outward, "direction out of the vessel, of any length");
}

void OpeningCase::declare(Fields& f) {
  f.integer("label", label, {0}, "of its triangles in the surface's file; 0: not said");
  f.numbers("near", near, {.count = 3, .dimension = dimension::length, .range = range::any},
            "the opening nearest to this point");
  f.integer("order", order, {0}, "by size: 1 the largest opening; 0: not said");
  f.group("cut", cut, "a plane that makes the opening: what lies beyond is cut off");
  f.number("trim", trim, dimension::length, range::not_negative,
           "cut off that much of the vessel, along its centreline");
}

void EdgeCase::declare(Fields& f) {
  f.number("longest", longest, dimension::length, range::positive, "edge; of all edges if per_radius is 0");
  f.number("shortest", shortest, dimension::length, range::positive, "edge, with per_radius");
  f.number("per_radius", per_radius, dimension::none, {0, 2},
           "an edge's length over the vessel's radius there; 0: all alike");
  f.check(per_radius == 0 || shortest <= longest, "shortest", "must not be above longest");
}

void StudyCase::declare(Fields& f) {
  f.text("name", name, "of the study; results go to out/NAME", Need::required);
  f.check(is_file_name(name), "name", std::string(file_name_rule));
  f.group("surface", surface, "of the lumen, as a file; or:");
  f.group("image", image, "a volume that shows the lumen; or:");
  f.group("contours", contours,
          "closed ones of the lumen, from inlet to outlet: the first opening has the label 1, the last 2");
  f.group("repair", repair, "what is mended of it");
  f.groups("openings", openings, "the vessel's ends, each by label, near, order or cut", Need::required);
  f.text("inlet", inlet, "the opening that blood enters", Need::required);
  f.text("trunk", trunk, "the outlet that the main vessel leads to; empty: the largest");
  f.number("centreline_spacing", centreline_spacing, dimension::length, range::positive,
           "between points of centrelines");
  f.group("edges", edges, "of the triangles");
  f.group("model", model, "meshes of the blood and of the wall, and a case that runs; absent: the surface alone");
  f.check(surface.has_value() + image.has_value() + contours.has_value() == 1, "surface",
          "or image or contours must be given, one of them");
  const auto is_opening = [this](const std::string& one) {
    return std::any_of(openings.begin(), openings.end(), [&](const auto& o) { return o.first == one; });
  };
  f.check(inlet.empty() || is_opening(inlet), "inlet", "must be one of the openings");
  f.check(trunk.empty() || (is_opening(trunk) && trunk != inlet), "trunk", "must be one of the other openings");
  for (const auto& [one, o] : openings)
    f.check((o.label > 0) + (o.order > 0) + !o.near.empty() + o.cut.has_value() == 1, "openings",
            "must each have one of label, near, order and cut");
}

std::string StudyCase::where(const std::string& field) const {
  for (std::string known = field;; known.resize(known.rfind('.'))) {
    if (const auto line = lines.find(known); line != lines.end()) return line->second + ": " + field;
    if (known.find('.') == std::string::npos) return path.empty() ? field : path.string() + ": " + field;
  }
}

namespace {

/// The line of each field below a node.
void find_lines(const YamlNode& node, const std::string& field, std::map<std::string, std::string>& lines) {
  for (const auto& entry : node.entries) {
    const std::string path = field.empty() ? entry.key : field + "." + entry.key;
    lines[path] = entry.place.text();
    find_lines(entry.value, path, lines);
  }
}

/// Names of branches are those of the outlets that their lines lead to: what is none of them is found before anything
/// is built.
class BranchNames {
 public:
  BranchNames(const StudyCase& study, Problems& problems) : problems_(problems) {
    for (const auto& [name, opening] : study.openings)
      if (name != study.inlet) outlets_.push_back(name);
  }

  void check(const YamlNode& model) {
    if (const YamlNode* wall = model.find("wall"))
      if (const YamlNode* branches = wall->find("branches"))
        for (const auto& entry : branches->entries) check(entry.key, "model.wall.branches", entry.place);
    if (const YamlNode* regions = model.find("regions"))
      for (const auto& region : regions->entries) check_region(region.value, "model.regions." + region.key);
  }

 private:
  void check_region(const YamlNode& region, const std::string& field) {
    if (const YamlNode* branches = region.find("branches"))
      for (const YamlNode& item : branches->items) check(item.text, field + ".branches", item.place);
    if (const YamlNode* line = region.find("line")) check(line->text, field + ".line", line->place);
  }
  void check(const std::string& name, const std::string& field, const YamlPlace& place) {
    if (!name.empty() && std::find(outlets_.begin(), outlets_.end(), name) == outlets_.end())
      problems_.add(
          place, fmt::format("{}: there is no branch '{}': each is named as its outlet, of which there are {}", field,
                             name, fmt::join(outlets_, ", ")));
  }

  Problems& problems_;
  std::vector<std::string> outlets_;
};

}  // namespace

StudyCase read_study(const std::filesystem::path& file) {
  const YamlNode tree = read_case_tree(file);
  if (tree.kind == YamlNode::Kind::scalar || tree.kind == YamlNode::Kind::list)
    throw input_error("{}: a study is a section of named fields, such as 'name: arch'", tree.place.text());
  const UnitSystem units = UnitSystem::cgs();
  Problems problems;
  StudyCase study;
  study.path = file;
  Reader reader(tree, units, problems);
  study.declare(reader);
  reader.report_unknown();
  problems.throw_if_any();
  if (const YamlNode* model = tree.find("model")) BranchNames(study, problems).check(*model);
  problems.throw_if_any();
  find_lines(tree, "", study.lines);
  if (study.image) study.image->lines = study.lines;
  return study;
}

std::string study_reference(const std::string& format) {
  Describe describe(UnitSystem::cgs());
  StudyCase study;
  study.declare(describe);
  return format == "markdown" ? describe.markdown() : describe.text();
}

}  // namespace tether
