#include "observation_manager/measurements/observation_case.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

namespace tether {
namespace {

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

ObservationsCase::ObservationsCase() {
  for (const MeasurementKind* kind : measurement_kinds()) sections_.push_back(kind->section());
}

ObservationsCase::ObservationsCase(const ObservationsCase& other) {
  for (const auto& section : other.sections_) sections_.push_back(section->copy());
}

void ObservationsCase::declare(Fields& f) {
  for (const auto& section : sections_) section->declare(f);
}

bool ObservationsCase::has_lumen_data() const {
  return std::any_of(sections_.begin(), sections_.end(),
                     [](const auto& section) { return section->kind().on_lumen && !section->names().empty(); });
}

}  // namespace tether
