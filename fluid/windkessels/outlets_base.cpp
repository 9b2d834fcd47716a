#include "fluid/windkessels/outlets_base.hpp"

#include <algorithm>

#include "common/base/error.hpp"
#include "common/config/case_file.hpp"
#include "common/config/case_tree.hpp"
#include "common/config/reader.hpp"
#include "common/config/rules.hpp"
#include "common/mesh/patch.hpp"
#include "vessel/mesh_case.hpp"

namespace tether {
namespace {

std::vector<std::string> entries_of(const YamlNode* section) {
  std::vector<std::string> names;
  if (section)
    for (const auto& entry : section->entries) names.push_back(entry.key);
  return names;
}

/// The flow of an inlet, if it is a curve.
std::optional<CurveCase> flow_of(const YamlNode& inlet, const UnitSystem& units) {
  if (!inlet.find("flow")) return std::nullopt;
  Problems problems;
  Reader reader(inlet, units, problems);
  CurveCase flow(dimension::flow);
  reader.group("flow", flow, "through the inlet");
  problems.throw_if_any();
  return flow;
}

}  // namespace

OutletsBase read_outlets_base(const std::filesystem::path& case_file) {
  const CaseFile file(case_file);
  const YamlNode tree = read_case_tree(case_file);
  const YamlNode* fluid = tree.find("fluid");
  const YamlNode* inlets = fluid ? fluid->find("inlets") : nullptr;
  OutletsBase base;
  base.units = file.units();
  base.outlets = entries_of(fluid ? fluid->find("outlets") : nullptr);
  base.inlets = entries_of(inlets);
  if (base.inlets.size() == 1) base.flow = flow_of(inlets->entries.front().value, base.units);
  base.start = file.common().time.start;
  base.image_pressure = base.units.to_mmhg(file.common().image.pressure);
  if (base.outlets.empty()) throw input_error("{}: has no outlets", file.where("fluid.outlets"));
  return base;
}

std::vector<double> outlet_areas(const std::filesystem::path& case_file, const std::vector<std::string>& names) {
  CaseFile file(case_file);
  MeshCase section;
  file.read("mesh", section);
  file.finish();
  const VesselMesh mesh = load_mesh(section, file, WallElement::prism);
  const double square_centimetre = UnitSystem::cgs().in_si(dimension::area) / file.units().in_si(dimension::area);
  std::vector<double> areas;
  for (const std::string& name : names) {
    const auto& all = mesh.fluid.outlets;
    const auto patch = std::find_if(all.begin(), all.end(), [&](const Patch& one) { return one.name == name; });
    if (patch == all.end()) throw input_error("{}: its mesh has no outlet '{}'", case_file.string(), name);
    areas.push_back(area_of(mesh.fluid.points, *patch) / square_centimetre);
  }
  return areas;
}

}  // namespace tether
