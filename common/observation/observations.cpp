#include "common/observation/observations.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "common/observation/contour_file.hpp"
#include "common/observation/surface_check.hpp"
#include "common/observation/surface_files.hpp"

namespace tether {
namespace {

/// Where a source stands in the case.
struct Place {
  const CaseFile& file;
  std::string field;  ///< "observations.surfaces.ct"
  std::string where(const std::string& part) const { return file.where(field + "." + part); }
};

/// For each node none, or why the case does not want it observed.
std::vector<Exclusion> excluded_nodes(const LumenDataCase& data, const LumenSurface& lumen, const Place& place) {
  std::vector<bool> masked(lumen.region_names.size(), false);
  for (const std::string& name : data.masked_regions) {
    const auto found = std::find(lumen.region_names.begin(), lumen.region_names.end(), name);
    if (found == lumen.region_names.end())
      throw input_error("{}: {}: the wall has no such region; it has: {}", place.where("masked_regions"), name,
                        fmt::join(lumen.region_names, ", "));
    masked[static_cast<std::size_t>(found - lumen.region_names.begin())] = true;
  }
  std::vector<Exclusion> excluded;
  for (Eigen::Index node = 0; node < lumen.points.cols(); ++node) {
    const int region = lumen.region[static_cast<std::size_t>(node)];
    const bool near_end = lumen.from_inlet[node] < data.inlet_band || lumen.from_outlet[node] < data.outlet_band;
    excluded.push_back(region >= 0 && masked[static_cast<std::size_t>(region)] ? Exclusion::masked
                       : near_end                                              ? Exclusion::near_end
                                                                               : Exclusion::none);
  }
  if (std::count(excluded.begin(), excluded.end(), Exclusion::none) == 0)
    throw input_error("{}: masked regions and bands leave no place of the lumen to observe",
                      place.file.where(place.field));
  return excluded;
}

SourceSettings settings_of(const LumenDataCase& data, double period, const LumenSurface& lumen, const Place& place) {
  SourceSettings settings;
  settings.name = place.field.substr(place.field.rfind('.') + 1);
  settings.period = period;
  settings.time_tolerance = 0.5 * place.file.common().time.step;
  if (data.trust_distance) settings.trust_distance = *data.trust_distance;
  settings.of_node = excluded_nodes(data, lumen, place);
  settings.region = lumen.region;
  settings.noise = noise_of(data.noise);
  return settings;
}

void check_held_out(const LumenDataCase& data, const std::vector<double>& frames, const Place& place) {
  for (const double number : data.held_out)
    if (std::find(frames.begin(), frames.end(), number) == frames.end())
      throw input_error("{}: there is no frame {:g}; frames are numbered {:g} to {:g}", place.where("held_out"), number,
                        frames.front(), frames.back());
  if (data.held_out.size() >= frames.size())
    throw input_error("{}: all {} frames: one at least must be left to the model", place.where("held_out"),
                      frames.size());
}

/// A series that does not repeat must have something to say during the run.
void check_range(double first, double last, double period, const Place& place) {
  const TimeCase& run = place.file.common().time;
  if (period > 0 || std::isnan(first) || (first <= run.end && last >= run.start)) return;
  throw input_error("{}: its frames are from {:g} to {:g}, the run is from {:g} to {:g}: period or time_shift?",
                    place.file.where(place.field), first, last, run.start, run.end);
}

/// How far data may be from the model and still be of the same vessel.
double reach_of(const LumenDataCase& data, const LumenSurface& lumen) {
  const Vec3 size = lumen.points.rowwise().maxCoeff() - lumen.points.rowwise().minCoeff();
  return data.trust_distance.value_or(0.25 * size.norm());
}

std::unique_ptr<LumenSeries> load(const SurfacesCase& given, const LumenSurface& lumen, const Place& place) {
  const UnitSystem& units = place.file.units();
  const std::vector<TimedFile> files = files_of(given, units);
  const double scale = units.quantity("1 " + given.unit, dimension::length), period = given.period.value_or(0);
  std::vector<SurfaceFrame> frames;
  std::vector<std::string> notes;
  std::vector<double> numbers;
  std::vector<bool> held_out;
  for (const TimedFile& timed : files) {
    const std::string name = timed.file.string();
    CheckedSurface checked = checked_surface(name, read_surface(timed.file, scale));
    check_overlap(name, checked.surface, lumen, reach_of(given.data, lumen));
    for (const std::string& note : checked.notes) notes.push_back(timed.file.filename().string() + ": " + note);
    numbers.push_back(static_cast<double>(frames.size()));
    held_out.push_back(std::find(given.data.held_out.begin(), given.data.held_out.end(), numbers.back()) !=
                       given.data.held_out.end());
    frames.push_back({timed.time, std::move(checked.surface), std::move(checked.flawed)});
  }
  check_held_out(given.data, numbers, place);
  check_range(frames.front().time, frames.back().time, period, place);
  return std::make_unique<SurfaceSeries>(settings_of(given.data, period, lumen, place), std::move(frames), held_out,
                                         lumen, std::move(notes));
}

void check_overlap(const ContourSeries& series, const LumenSurface& lumen, double reach, const std::string& file) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Frame& frame : series.frames())
    for (const Sample& sample : series.observe(lumen.points, frame)) {
      if (sample.excluded == Exclusion::none && std::abs(sample.distance) <= reach) return;
      if (sample.excluded != Exclusion::missed) nearest = std::min(nearest, std::abs(sample.distance));
    }
  std::vector<Vec3> corners;
  for (const ContourTrack& track : series.tracks())
    for (const auto& p : track.contours.front().points().colwise())
      corners.push_back(track.plane.origin + track.plane.lifted(p));
  Points data(3, static_cast<Eigen::Index>(corners.size()));
  for (std::size_t i = 0; i < corners.size(); ++i) data.col(static_cast<Eigen::Index>(i)) = corners[i];
  const std::string why = std::isfinite(nearest) ? fmt::format("the nearest place is {:.3g} away", nearest)
                                                 : "no slice cuts the model's lumen";
  throw input_error("{}: does not overlap the model: {}; {}", file, why, placement(data, lumen.points));
}

std::unique_ptr<LumenSeries> load(const SlicesCase& given, const LumenSurface& lumen, const Place& place) {
  std::vector<std::string> notes;
  std::vector<ContourTrack> tracks = read_contour_tracks(given, place.file.units(), notes);
  const double period = given.beat.value_or(given.period.value_or(0));
  double first = infinite, last = -infinite;
  for (const ContourTrack& track : tracks) {
    first = std::min(first, track.times.front()), last = std::max(last, track.times.back());
    if (std::count(track.held_out.begin(), track.held_out.end(), false) == 0)
      throw input_error("{}: all frames of {}: one at least must be left to the model", place.where("held_out"),
                        track.name);
  }
  check_range(first, last, period, place);
  auto series = std::make_unique<ContourSeries>(settings_of(given.data, period, lumen, place), std::move(tracks),
                                                given.samples, lumen, std::move(notes));
  check_overlap(*series, lumen, reach_of(given.data, lumen), given.file.string());
  return series;
}

/// Some place where a velocity was measured must lie in the box of the lumen.
void check_overlap(const VelocitySeries& series, const LumenSurface& lumen, const CaseFile& file) {
  const Vec3 low = lumen.points.rowwise().minCoeff(), high = lumen.points.rowwise().maxCoeff();
  for (const auto& x : series.points().colwise())
    if ((x.array() >= low.array()).all() && (x.array() <= high.array()).all()) return;
  throw input_error("{}: does not overlap the model: {}",
                    file.where("observations.velocities." + series.settings().name),
                    placement(series.points(), lumen.points));
}

/// What is said of several files in the same words, once: "lumen_0.stl and 9 others: ...".
std::vector<std::string> merged(const std::vector<std::string>& notes) {
  std::vector<std::pair<std::string, std::vector<std::string>>> said;  // words, files
  for (const std::string& note : notes) {
    const auto colon = note.find(": ");
    const std::string file = colon == std::string::npos ? "" : note.substr(0, colon),
                      words = colon == std::string::npos ? note : note.substr(colon + 2);
    const auto known = std::find_if(said.begin(), said.end(), [&](const auto& s) { return s.first == words; });
    if (known == said.end())
      said.push_back({words, {file}});
    else
      known->second.push_back(file);
  }
  std::vector<std::string> all;
  for (const auto& [words, files] : said) {
    const std::string others = files.size() > 1 ? fmt::format(" and {} more", files.size() - 1) : "";
    all.push_back(files.front().empty() ? words : files.front() + others + ": " + words);
  }
  return all;
}

}  // namespace

std::vector<Sample> Observations::observe(const Points& x, double time) const {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < lumen.size(); ++i)
    for (Sample& sample : lumen[i]->observe(x, time)) {
      sample.source = static_cast<int>(i);
      samples.push_back(sample);
    }
  return samples;
}

std::vector<std::string> Observations::notes() const {
  std::vector<std::string> all;
  for (const auto& series : lumen)
    for (const std::string& note : merged(series->notes())) all.push_back(series->settings().name + ": " + note);
  return all;
}

Observations load_observations(const ObservationsCase& given, const LumenSurface& lumen, const CaseFile& file) {
  Observations result{load_flow_observations(given, file), {}};
  for (const auto& [name, source] : given.surfaces)
    result.lumen.push_back(load(source, lumen, {file, "observations.surfaces." + name}));
  for (const auto& [name, source] : given.contours)
    result.lumen.push_back(load(source, lumen, {file, "observations.contours." + name}));
  for (const VelocitySeries& series : result.velocities) check_overlap(series, lumen, file);
  return result;
}

}  // namespace tether
