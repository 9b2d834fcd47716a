#include "common/observation/observation_case.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <numbers>

namespace tether {
namespace {

constexpr Word millimetre{"mm", "millimetre"}, centimetre{"cm", "centimetre"}, metre{"m", "metre"};

Vec3 vector_of(const std::vector<double>& numbers) {
  return numbers.size() == 3 ? Vec3(numbers.data()) : Vec3::Zero();
}

}  // namespace

void NoiseCase::declare(Fields& f) {
  f.number("deviation", deviation, dimension, range::not_negative,
           "standard deviation of a single value; 0: not known");
  f.number("correlation_length", correlation_length, dimension::length, range::not_negative,
           "distance along the wall within which errors are alike; 0: not known");
  f.number("correlation_time", correlation_time, dimension::time, range::not_negative,
           "time within which errors are alike; 0: not known");
}

void CorrectionCase::declare(Fields& f) {
  f.numbers("displacement", displacement, {3, dimension::length, range::any}, "added to the data's coordinates");
  f.numbers("rotation", rotation, {3, dimension::none, range::any},
            "axis times angle in radians by which the data are turned, before they are displaced");
  f.numbers("about", about, {3, dimension::length, range::any}, "point about which they are turned; absent: 0, 0, 0");
  f.number("outward", outward, dimension::length, range::any,
           "by which the measured lumen is moved out along its normal: that much was segmented too small");
  constexpr double eighth_of_a_turn = 0.786;
  f.check(vector_of(rotation).norm() < eighth_of_a_turn, "rotation", "must be below 45 degrees; it is in radians");
}

std::vector<std::string> CorrectionCase::notes(const std::string& unit) const {
  std::vector<std::string> all;
  const Vec3 by = vector_of(displacement), turned = vector_of(rotation);
  if (turned.norm() > 0)
    all.push_back(fmt::format("corrected: turned by {:.3g} degrees", turned.norm() * 180 / std::numbers::pi));
  if (by.norm() > 0)
    all.push_back(fmt::format("corrected: displaced by ({:.3g}, {:.3g}, {:.3g}) {}", by(0), by(1), by(2), unit));
  if (outward != 0) all.push_back(fmt::format("corrected: moved outward by {:.3g} {}", outward, unit));
  return all;
}

Points CorrectionCase::corrected(Points points) const {
  const Vec3 turned = vector_of(rotation), by = vector_of(displacement), middle = vector_of(about);
  if (turned.norm() > 0)
    points = (Eigen::AngleAxisd(turned.norm(), turned.normalized()).toRotationMatrix() * (points.colwise() - middle))
                 .colwise() +
             middle;
  return points.colwise() + by;
}

void LumenDataCase::declare(Fields& f) {
  f.number("time_shift", time_shift, dimension::time, range::any, "added to the data's times");
  f.number("trust_distance", trust_distance, dimension::length, range::positive,
           "data farther than this from the model are no observation; absent: no limit");
  f.texts("masked_regions", masked_regions, "regions of the wall behind which nothing is observed");
  f.number("inlet_band", inlet_band, dimension::length, range::not_negative,
           "nothing is observed within this distance of an inlet's rim");
  f.number("outlet_band", outlet_band, dimension::length, range::not_negative,
           "nothing is observed within this distance of an outlet's rim");
  f.numbers("held_out", held_out, {0, dimension::none, range::not_negative},
            "numbers of frames (from 0) that the model never sees: they judge it");
  f.numbers("left_out", left_out, {0, dimension::none, range::not_negative},
            "numbers of frames (from 0) that are not used at all; the others keep their numbers");
  f.group("correction", correction, "what is wrong with the data, taken off them");
  f.group("noise", noise, "errors of the distances");
}

void SurfacesCase::declare(Fields& f) {
  f.path("file", file,
         "a series: .pvd, or .csv with the columns file and time; or one surface (.vtp, .stl, .ply, .vtk)");
  f.path("folder", folder, "of one surface a frame, instead of a file");
  f.text("pattern", pattern, "of the names in that folder, sorted by the numbers in them: frame_*.stl");
  f.number("first_time", first_time, dimension::time, range::any, "time of the first surface in the folder");
  f.number("interval", interval, dimension::time, range::positive, "time between two surfaces of the folder");
  f.choice("unit", unit, {millimetre, centimetre, metre}, "of the files' coordinates");
  f.number("period", period, dimension::time, range::positive, "the series repeats after this time");
  data.declare(f);
  f.check(file.empty() != folder.empty(), "file", "give either a file or a folder with a pattern");
  f.check(folder.empty() || !pattern.empty(), "pattern", "must be given with folder");
  f.check(folder.empty() || (first_time && interval), "first_time", "must be given with folder, and interval too");
}

void SlicesCase::declare(Fields& f) {
  f.path("file", file, "CSV file with the columns slice, frame, time, x, y, z, and contour and closed if needed",
         Need::required);
  f.texts("slices", slices, "names of the slices that are used; absent: all of the file");
  f.choice("unit", unit, {{"heading", "stated as [mm] behind the columns' names"}, millimetre, centimetre, metre},
           "of the file's coordinates");
  f.number("beat", beat, dimension::time, range::positive,
           "duration of a beat, if the file's times are fractions of it; the series then repeats after it");
  f.number("period", period, dimension::time, range::positive, "the series repeats after this time");
  f.check(!(beat && period), "period", "give either beat or period");
  f.integer("samples", samples, {8, 10000}, "places around each contour at which distances are taken");
  data.declare(f);
}

void declare_quantity(Fields& f, std::string& quantity, Dimension& dimension) {
  f.choice("quantity", quantity,
           {{"pressure", "in the blood"},
            {"flow", "through an opening"},
            {"length", "a displacement, a diameter"},
            {"volume", "of the lumen"},
            {"force", "of a support"}},
           "what it is");
  const std::vector<std::pair<std::string_view, Dimension>> dimensions{{"pressure", dimension::pressure},
                                                                       {"flow", dimension::flow},
                                                                       {"length", dimension::length},
                                                                       {"volume", dimension::volume},
                                                                       {"force", dimension::force}};
  for (const auto& [word, of_word] : dimensions)
    if (quantity == word) dimension = of_word;
}

void TraceCase::declare(Fields& f) {
  f.text("observable", observable, "column of timeseries.csv: fluid.outlet.pressure", Need::required);
  declare_quantity(f, quantity, noise.dimension);
  curve.dimension = noise.dimension;
  f.group("curve", curve, "the measured values over time");
  f.check(!curve.constant, "curve", "give a file: a constant is no measurement");
  f.number("time_shift", time_shift, dimension::time, range::any, "added to the data's times");
  f.when("quantity", quantity, {"pressure"}, [&] {
    f.flag("absolute", absolute, "the pressure of the image is subtracted, to which the run's pressures are relative");
  });
  f.flag("held_out", held_out, "the model never sees it: it judges");
  f.group("noise", noise, "errors of the values");
}

void VelocitiesCase::declare(Fields& f) {
  f.path("file", file, "CSV file with the columns time, x, y, z and vx, vy, vz, or v, units in the headings",
         Need::required);
  f.choice("components", components,
           {{"vector", "all three: columns vx, vy, vz"},
            {"along", "the one along `direction`, as through a plane of phase-contrast MR: column v"}},
           "what of the velocity was measured");
  f.when("components", components, {"along"},
         [&] { f.point("direction", direction, dimension::none, "in which v is positive; of any length"); });
  f.number("beat", beat, dimension::time, range::positive,
           "duration of a beat, if the file's times are fractions of it; the series then repeats after it");
  f.number("period", period, dimension::time, range::positive, "the series repeats after this time");
  f.check(!(beat && period), "period", "give either beat or period");
  f.check(components != "along" || !direction.allFinite() || direction.norm() > 0, "direction", "must not be zero");
  f.number("time_shift", time_shift, dimension::time, range::any, "added to the data's times");
  f.numbers("held_out", held_out, {0, dimension::none, range::not_negative},
            "numbers of frames (from 0) that the model never sees: they judge it");
  f.group("noise", noise, "errors of a component");
}

void ObservationsCase::declare(Fields& f) {
  f.groups("surfaces", surfaces, "segmented surfaces of the lumen, by name");
  f.groups("contours", contours, "contours of the lumen in slices, by name");
  f.groups("traces", traces, "measured pressures and flows, by name");
  f.groups("velocities", velocities,
           "velocities of the blood measured at points of space, on planes as a rule, by name");
}

}  // namespace tether
