#include "fluid/windkessels/outlets_case.hpp"

#include "common/base/error.hpp"
#include "common/base/name.hpp"
#include "common/config/case_tree.hpp"
#include "common/config/describe.hpp"
#include "common/config/reader.hpp"

namespace tether {

void TargetPressureCase::declare(Fields& f) {
  f.number("mean", mean, dimension::pressure, range::positive, "over the beat, where the outlets are joined; absolute");
  f.number("pulse", pulse, dimension::pressure, range::positive, "largest less smallest of the beat");
  f.group("curve", curve, "measured over a beat, absolute, instead of mean and pulse: the elements are fitted to it");
  f.number("venous", venous, dimension::pressure, range::any, "behind the distal resistances; absolute");
  f.number("image", image, dimension::pressure, range::not_negative,
           "in the image, to which pressures of the new case are relative: the new case gets it; default: the case's");
  f.check(curve ? !mean && !pulse : mean && pulse, "mean", "give mean and pulse, or a curve");
  f.check(!mean || *mean > venous, "mean", "must be above venous");
}

void SplitCase::declare(Fields& f) {
  f.choice("by", by,
           {{"shares", "each outlet's share is given; needless for one outlet"},
            {"area", "as the areas"},
            {"murray", "as the radii to a power"}},
           "of the flow between the outlets");
  f.when("by", by, {"murray"}, [&] {
    f.number("exponent", exponent, dimension::none, {1, 4}, "of the radius: 3 by Murray (1926); 2 shares as the areas");
  });
}

void ProximalCase::declare(Fields& f) {
  f.number("share", share, dimension::none, {0.001, 0.5},
           "of each outlet's whole resistance; default: that of the human systemic circulation (Laskey 1990)");
  f.number("wave_speed", wave_speed, dimension::velocity, range::positive,
           "of the pulse in the outlet's vessel; the resistance is then its characteristic impedance, density "
           "wave_speed/area, and share is not used");
  f.number("density", density, dimension::density, range::positive, "of blood, with wave_speed");
}

void TargetOutletCase::declare(Fields& f) {
  f.number("share", share, dimension::none, {1e-4, 1}, "of the flow");
  f.number("area", area, dimension::area, range::positive, "of its cross-section; default: that of the case's mesh");
}

void OutletsCase::declare(Fields& f) {
  f.text("name", name, "of the fit; results go to out/NAME", Need::required);
  f.check(is_file_name(name), "name", std::string(file_name_rule));
  f.path("case", case_file,
         "case file whose outlets these are: a case with the elements is written that builds on it, which begins in "
         "the periodic state");
  f.group("flow", flow, "into all outlets over a beat; default: that of the case's only inlet");
  f.number("mean_flow", mean_flow, dimension::flow, range::positive, "the flow is scaled to this mean");
  f.number("vessel_compliance", vessel_compliance, dimension::compliance, range::not_negative,
           "of the vessel itself, which takes up its part of a beat: how much larger its volume is in a run where its "
           "pressure is larger by one");
  f.group("pressure", pressure, "that the outlets are to make");
  f.group("split", split, "of the flow");
  f.groups("outlets", outlets, "by name; none: those of the case");
  f.group("proximal", proximal, "resistances before the reservoirs; with a pressure curve they are fitted instead");
  f.check(flow || !case_file.empty(), "flow", "must be given where there is no case");
  f.check(!flow || flow->period.has_value(), "flow", "needs a period");
  f.check(!outlets.empty() || !case_file.empty(), "outlets", "must be given where there is no case");
  constexpr std::size_t most = 300;  // a beat of them takes the cube of their number
  f.check(outlets.size() <= most, "outlets", fmt::format("are {}: must be at most {}", outlets.size(), most));
  f.check(!(has_curve() && proximal.wave_speed), "proximal", "wave_speed is of no use with a pressure curve");
}

OutletsCase read_outlets_case(const std::filesystem::path& file) {
  const YamlNode tree = read_yaml(file);
  if (tree.kind == YamlNode::Kind::scalar || tree.kind == YamlNode::Kind::list)
    throw input_error("{}: must be named fields, such as 'name: arch'", tree.place.text());
  const UnitSystem units = UnitSystem::cgs();
  Problems problems;
  OutletsCase outlets;
  Reader reader(tree, units, problems);
  outlets.declare(reader);
  reader.report_unknown();
  problems.throw_if_any();
  return outlets;
}

std::string outlets_reference(const std::string& format) {
  Describe describe(UnitSystem::cgs());
  OutletsCase outlets;
  outlets.declare(describe);
  return format == "markdown" ? describe.markdown() : describe.text();
}

}  // namespace tether
