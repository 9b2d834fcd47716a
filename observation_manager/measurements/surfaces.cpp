#include "observation_manager/measurements/surfaces.hpp"

namespace tether {
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

const MeasurementKind kinds::surfaces{
    .name = "surfaces",
    .meaning = "segmented surfaces of the lumen, by name",
    .formats = "one surface a frame in .vtp, .stl, .ply or .vtk; a list of them in .pvd or .csv",
    .fallible = fallible::image,
    .on_lumen = true,
    .pulls_wall = true,
    .section = section_of<SurfacesCase, kinds::surfaces>};

}  // namespace tether
