#include "vessel/ring/ring_case.hpp"

#include "common/base/error.hpp"
#include "common/base/name.hpp"
#include "common/config/case_tree.hpp"
#include "common/config/columns.hpp"
#include "common/config/describe.hpp"
#include "common/config/reader.hpp"

namespace tether {

void FramesCase::declare(Fields& f) {
  f.path("file", file, "CSV file with a row for each frame", Need::required);
  f.text("column", column, "column that names the frame's surface, relative to the table");
  f.text("time", time, "column of the time");
  f.choice("unit", unit, {{"mm", "the surfaces' coordinates are millimetres"}, {"cm", "centimetres"}, {"m", "metres"}},
           "of the surfaces");
  f.text("label_array", label_array, "the surfaces' labels of triangles, if they have any");
  f.flag("any_size", any_size, "do not refuse openings that no vessel has, which mostly mean a wrong unit");
  check_column(f, "column", column, file);
  check_column(f, "time", time, file);
}

void WhichRingCase::declare(Fields& f) {
  f.integer("label", label, {0}, "of the cap that closes this opening; 0: not said");
  f.numbers("near", near, {.count = 3, .dimension = dimension::length, .range = range::any},
            "the opening nearest to this point in the first frame");
  f.check(label == 0 || near.empty(), "near", "give a label or a point");
}

void LandmarkCase::declare(Fields& f) {
  f.path("file", file, "CSV file with the point's place over time", Need::required);
  f.text("time", time, "column of the time");
  f.text("x", x, "column of the x coordinate");
  f.text("y", y, "column of the y coordinate");
  f.text("z", z, "column of the z coordinate");
  f.text("unit", unit, "of the coordinates, if their headings do not state it as [unit]; else cm");
  for (const auto& [field, column] : {std::pair{"time", time}, {"x", x}, {"y", y}, {"z", z}})
    check_column(f, field, column, file);
}

void RingTrackCase::declare(Fields& f) {
  f.text("name", name, "of what is tracked; results go to out/NAME", Need::required);
  f.check(is_file_name(name), "name", std::string(file_name_rule));
  f.group("frames", frames, "surfaces of the lumen over time");
  f.group("ring", ring, "which opening; default: the largest");
  f.group("landmark", landmark, "a point that goes with the ring; absent: no turn about the ring's own axis is seen");
}

RingTrackCase read_ring_case(const std::filesystem::path& file) {
  const YamlNode tree = read_yaml(file);
  if (tree.kind == YamlNode::Kind::scalar || tree.kind == YamlNode::Kind::list)
    throw input_error("{}: must be named fields, such as 'name: root'", tree.place.text());
  Problems problems;
  RingTrackCase result;
  const UnitSystem units = UnitSystem::cgs();
  Reader reader(tree, units, problems);
  result.declare(reader);
  reader.report_unknown();
  problems.throw_if_any();
  return result;
}

std::string ring_reference(const std::string& format) {
  Describe describe(UnitSystem::cgs());
  RingTrackCase example;
  example.declare(describe);
  return format == "markdown" ? describe.markdown() : describe.text();
}

}  // namespace tether
