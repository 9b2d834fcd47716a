#include "observation_manager/measurements/observation_case.hpp"

#include <algorithm>

namespace tether {
void NoiseCase::declare(Fields& f) {
  f.number("deviation", deviation, dimension, range::not_negative,
           "standard deviation of a single value; 0: not known");
  constexpr double least = 1e-12, most = 1e12;  // of the unit: its square is divided by
  f.check(deviation == 0 || deviation >= least, "deviation",
          "must not be smaller than 1e-12: nothing is measured so well");
  f.check(deviation <= most, "deviation", "must not be larger than 1e12: nothing is measured so badly");
  f.number("correlation_length", correlation_length, dimension::length, range::not_negative,
           "distance along the wall within which errors are alike; 0: not known");
  f.number("correlation_time", correlation_time, dimension::time, range::not_negative,
           "time within which errors are alike; 0: not known");
  constexpr double shortest = 1e-9, longest = 1e9;  // of the unit: waves are made of its inverse
  const auto is_sane = [](double scale) { return scale == 0 || (scale >= shortest && scale <= longest); };
  f.check(is_sane(correlation_length), "correlation_length", "must be 0, or at least 1e-9 and at most 1e9");
  f.check(is_sane(correlation_time), "correlation_time", "must be 0, or at least 1e-9 and at most 1e9");
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
            "numbers of frames (from 0) that no number is fitted to: they judge");
  f.numbers("left_out", left_out, {0, dimension::none, range::not_negative},
            "numbers of frames (from 0) that are not used at all; the others keep their numbers");
  f.group("correction", correction, "what is wrong with the data, taken off them");
  f.group("noise", noise, "errors of the distances");
}

void ErrorRegionCase::declare(Fields& f) {
  f.texts("of", of, "regions of the wall; those of no name here count for the whole wall only");
  f.check(!of.empty(), "of", "must name at least one region of the wall");
}

ObservationsCase::ObservationsCase() {
  for (const MeasurementKind* kind : measurement_kinds()) sections_.push_back(kind->section());
}

ObservationsCase::ObservationsCase(const ObservationsCase& other) : regions(other.regions) {
  for (const auto& section : other.sections_) sections_.push_back(section->copy());
}

void ObservationsCase::declare(Fields& f) {
  for (const auto& section : sections_) section->declare(f);
  f.groups("regions", regions, "for which a comparison tells distances, by name; absent: those of the wall");
}

StatedErrors ObservationsCase::errors_of(const std::string& field) const {
  for (const auto& section : sections_)
    if (const std::string prefix = "observations." + section->kind().name + "."; field.starts_with(prefix))
      return section->errors_of(field.substr(prefix.size()));
  throw std::logic_error(field + ": no such source");
}

bool ObservationsCase::has_distances() const {
  return std::any_of(sections_.begin(), sections_.end(),
                     [](const auto& section) { return section->kind().pulls_wall && !section->names().empty(); });
}

}  // namespace tether
