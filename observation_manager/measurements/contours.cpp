#include "observation_manager/measurements/contours.hpp"

namespace tether {
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

const MeasurementKind kinds::contours{
    .name = "contours",
    .meaning = "contours of the lumen in slices, by name",
    .formats = "one .csv with a row for each point: slice, frame, time, x, y, z, and contour and closed if needed",
    .fallible = fallible::image,
    .on_lumen = true,
    .pulls_wall = true,
    .section = section_of<SlicesCase, kinds::contours>};

}  // namespace tether
