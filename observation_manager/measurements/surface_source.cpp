#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/base/error.hpp"
#include "observation_manager/measurements/lumen_kinds.hpp"
#include "observation_manager/measurements/lumen_source.hpp"
#include "observation_manager/measurements/open_ends.hpp"
#include "observation_manager/measurements/surface_check.hpp"
#include "observation_manager/measurements/surface_files.hpp"
#include "observation_manager/measurements/surface_series.hpp"

namespace tether {
namespace {

/// Frames are numbered from 0 to `count` - 1.
void check_frames(const LumenDataCase& data, std::size_t count, const LumenSource& source) {
  for (const auto& [field, numbers] : {std::pair{"held_out", &data.held_out}, {"left_out", &data.left_out}})
    for (const double number : *numbers)
      if (number >= static_cast<double>(count) || number != std::floor(number))
        throw input_error("{}: there is no frame {:g}; frames are numbered 0 to {}", source.where(field), number,
                          count - 1);
  std::size_t used = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (const auto number = static_cast<double>(i); !holds(data.held_out, number) && !holds(data.left_out, number))
      ++used;
  if (used == 0)
    throw input_error("{}: of {} frames one at least must be left to the model",
                      source.where(data.left_out.empty() ? "held_out" : "left_out"), count);
}

/// The files that are used; returns their numbers.
std::vector<double> drop_left_out(std::vector<TimedFile>& files, const LumenDataCase& data, const LumenSource& source) {
  check_frames(data, files.size(), source);
  std::vector<double> labels;
  std::vector<TimedFile> used;
  for (std::size_t i = 0; i < files.size(); ++i)
    if (const auto number = static_cast<double>(i); !holds(data.left_out, number)) {
      labels.push_back(number);
      used.push_back(files[i]);
    }
  files = used;
  return labels;
}

/// Throws InputError if a surface and its width are larger or smaller than the model's by the same power of ten.
void check_size(const std::string& name, const TriangleSurface& data, const LumenSurface& lumen,
                const std::string& unit) {
  const TriangleSurface model{lumen.points, lumen.triangles};
  const int power = power_of_ten(box_size(data.points) / box_size(model.points));
  if (power == 0 || power != power_of_ten(mean_radius(data) / mean_radius(model))) return;
  throw input_error("{}: {} {}", name, guessed_unit(power, unit), placement(data.points, lumen.points));
}

/// Which share of the places that a surface faces is near. Throws InputError if there is none, or fewer than there must
/// be, or if the surface's normals look against the model's; notes what is odd.
double checked_placing(const std::string& name, CheckedSurface& checked, const LumenSurface& lumen, double reach,
                       bool must_be_near) {
  const Placing found = placing_of(checked.surface, lumen, reach);
  if (found.opposed > 0.5)
    throw input_error(
        "{}: its normals look against those of the model's lumen at {:.0f} % of the places that it faces: is it the "
        "surface of the wall, and not of the lumen alone?",
        name, 100 * found.opposed);
  const std::string near = share_text(found.near, reach) + " and look the same way";
  if (found.near == 0 || (must_be_near && found.near < least_share))
    throw input_error("{}: does not overlap the model: {}, at least half must in one frame; {}", name, near,
                      placement(checked.surface.points, lumen.points));
  if (found.near < least_share) checked.notes.push_back("only " + near);
  if (found.faced < least_share)
    checked.notes.push_back(fmt::format("faces {:.0f} % of the model's lumen only", 100 * found.faced));
  return found.near;
}

std::unique_ptr<LumenSeries> load(const SurfacesCase& given, const LumenSurface& lumen, const LumenSource& source) {
  const UnitSystem& units = source.file.units();
  std::vector<TimedFile> files = files_of(given, units);
  const std::vector<double> labels = drop_left_out(files, given.data, source);
  const double scale = units.quantity("1 " + given.unit, dimension::length), period = given.period.value_or(0);
  std::vector<SurfaceFrame> frames;
  std::vector<Note> notes;
  note_corrections(notes, given.data, source.file);
  std::vector<bool> held_out;
  const std::vector<Opening> openings = openings_of(lumen);
  const double reach = reach_of(given.data, lumen);
  double best = 0;
  std::map<std::filesystem::path, std::size_t> first_frames;  ///< of files that may be listed again
  for (const TimedFile& timed : files) {
    const double label = labels[frames.size()];
    const std::string name = timed.file.string();
    const bool must_be_near = &timed == &files.back() && best < least_share;
    held_out.push_back(holds(given.data.held_out, label));
    const auto [first, is_new] = first_frames.emplace(timed.file, frames.size());
    if (!is_new && !must_be_near) {
      const SurfaceFrame& same = frames[first->second];
      frames.push_back({timed.time, same.surface, same.flawed, label});
      continue;
    }
    TriangleSurface read = read_surface(timed.file, scale);
    read.points = given.data.correction.faults.corrected(read.points);
    CheckedSurface checked = checked_surface(name, std::move(read));
    check_size(name, checked.surface, lumen, given.unit);
    open_ends(checked, openings);
    best = std::max(best, checked_placing(name, checked, lumen, reach, must_be_near));
    for (const std::string& note : checked.notes) notes.push_back({timed.file.filename().string(), note});
    frames.push_back({timed.time, std::move(checked.surface), std::move(checked.flawed), label});
  }
  check_range(frames.front().time, frames.back().time, period, source);
  return std::make_unique<SurfaceSeries>(settings_of(given.data, period, lumen, source), std::move(frames), held_out,
                                         lumen, std::move(notes));
}

}  // namespace

void load_surfaces(const KindSection& section, const LumenSurface& lumen, const CaseFile& file, Observations& to) {
  for (const auto& [name, source] : sources_of<SurfacesCase>(section))
    to.lumen.push_back(load(source, lumen, {file, "observations.surfaces." + name}));
}

}  // namespace tether
