#include "observation_manager/measurements/velocities.hpp"

#include "observation_manager/measurements/flow_observations.hpp"
#include "observation_manager/measurements/velocity_file.hpp"

namespace tether {
namespace {

void load_velocities_of(const KindSection& given, const CaseFile& file, FlowObservations& to) {
  for (const auto& [name, source] : sources_of<VelocitiesCase>(given))
    to.velocities.push_back(load_velocities(name, source, file));
}

}  // namespace

void VelocitiesCase::declare(Fields& f) {
  f.path("file", file, "CSV file with the columns time, x, y, z and vx, vy, vz, or v, units in the headings",
         Need::required);
  f.choice("components", components,
           {{"vector", "all three: columns vx, vy, vz"},
            {"along", "the one along `direction`, as through a plane of phase-contrast MR: column v"}},
           "what of the velocity was measured");
  f.when("components", components, {"along"},
         [&] { f.direction("direction", direction, "in which v is positive; of any length"); });
  f.number("beat", beat, dimension::time, range::positive,
           "duration of a beat, if the file's times are fractions of it; the series then repeats after it");
  f.number("period", period, dimension::time, range::positive, "the series repeats after this time");
  f.check(!(beat && period), "period", "give either beat or period");
  f.number("time_shift", time_shift, dimension::time, range::any, "added to the data's times");
  f.numbers("held_out", held_out, {0, dimension::none, range::not_negative},
            "numbers of frames (from 0) that no number is fitted to: they judge");
  f.group("noise", noise, "errors of a component");
}

const MeasurementKind kinds::velocities{
    .name = "velocities",
    .meaning = "velocities of the blood measured at points of space, on planes as a rule, by name",
    .formats = "one .csv with a row for each point and time: time, x, y, z and vx, vy, vz, or v",
    .fallible = {},
    .on_lumen = false,
    .section = section_of<VelocitiesCase, kinds::velocities>,
    .load = load_velocities_of};

}  // namespace tether
