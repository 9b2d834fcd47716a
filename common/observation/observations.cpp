#include "common/observation/observations.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "common/base/checked_file.hpp"
#include "common/base/error.hpp"
#include "common/observation/contour_file.hpp"
#include "common/observation/open_ends.hpp"
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
  settings.outward = data.correction.outward;
  if (const double radius = mean_radius({lumen.points, lumen.triangles}); std::abs(settings.outward) > 0.5 * radius)
    throw input_error("{}: {:g} is more than half of the vessel's mean radius, {:.3g}",
                      place.where("correction.outward"), settings.outward, radius);
  return settings;
}

bool holds(const std::vector<double>& numbers, double number) {
  return std::find(numbers.begin(), numbers.end(), number) != numbers.end();
}

/// Frames are numbered from 0 to `count` - 1.
void check_frames(const LumenDataCase& data, std::size_t count, const Place& place) {
  for (const auto& [field, numbers] : {std::pair{"held_out", &data.held_out}, {"left_out", &data.left_out}})
    for (const double number : *numbers)
      if (number >= static_cast<double>(count) || number != std::floor(number))
        throw input_error("{}: there is no frame {:g}; frames are numbered 0 to {}", place.where(field), number,
                          count - 1);
  std::size_t used = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (const auto number = static_cast<double>(i); !holds(data.held_out, number) && !holds(data.left_out, number))
      ++used;
  if (used == 0)
    throw input_error("{}: of {} frames one at least must be left to the model",
                      place.where(data.left_out.empty() ? "held_out" : "left_out"), count);
}

/// The files that are used; returns their numbers.
std::vector<double> drop_left_out(std::vector<TimedFile>& files, const LumenDataCase& data, const Place& place) {
  check_frames(data, files.size(), place);
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

/// What the case takes off the data.
void note_corrections(std::vector<std::string>& notes, const LumenDataCase& data, const CaseFile& file) {
  for (std::string& note : data.correction.notes(file.units().symbol(dimension::length)))
    notes.push_back(std::move(note));
  if (!data.left_out.empty()) notes.push_back(fmt::format("left out: frames {:g}", fmt::join(data.left_out, ", ")));
}

/// A series that does not repeat must have something to say during the run.
void check_range(double first, double last, double period, const Place& place) {
  const TimeCase& run = place.file.common().time;
  if (period > 0 || std::isnan(first) || (first <= run.end && last >= run.start)) return;
  throw input_error("{}: its frames are from {:g} to {:g}, the run is from {:g} to {:g}: period or time_shift?",
                    place.file.where(place.field), first, last, run.start, run.end);
}

/// How far data may be from the model and still be of the same vessel: as far as they are trusted, or its radius.
double reach_of(const LumenDataCase& data, const LumenSurface& lumen) {
  return data.trust_distance.value_or(mean_radius({lumen.points, lumen.triangles}));
}

/// Of the places that data face, half must lie within reach, in one frame at least.
constexpr double least_share = 0.5;

std::string share_text(double share, double reach) {
  return fmt::format("{:.2g} % of the places of the lumen that it faces lie within {:.3g} of it", 100 * share, reach);
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
        "{}: its normals look against those of the model's lumen at {:.2g} % of the places that it faces: is it the "
        "surface of the wall, and not of the lumen alone?",
        name, 100 * found.opposed);
  const std::string near = share_text(found.near, reach) + " and look the same way";
  if (found.near == 0 || (must_be_near && found.near < least_share))
    throw input_error("{}: does not overlap the model: {}, at least half must in one frame; {}", name, near,
                      placement(checked.surface.points, lumen.points));
  if (found.near < least_share) checked.notes.push_back("only " + near);
  if (found.faced < least_share)
    checked.notes.push_back(fmt::format("faces {:.2g} % of the model's lumen only", 100 * found.faced));
  return found.near;
}

std::unique_ptr<LumenSeries> load(const SurfacesCase& given, const LumenSurface& lumen, const Place& place) {
  const UnitSystem& units = place.file.units();
  std::vector<TimedFile> files = files_of(given, units);
  const std::vector<double> labels = drop_left_out(files, given.data, place);
  const double scale = units.quantity("1 " + given.unit, dimension::length), period = given.period.value_or(0);
  std::vector<SurfaceFrame> frames;
  std::vector<std::string> notes;
  note_corrections(notes, given.data, place.file);
  std::vector<bool> held_out;
  const std::vector<Opening> openings = openings_of(lumen);
  const double reach = reach_of(given.data, lumen);
  double best = 0;
  for (const TimedFile& timed : files) {
    const double label = labels[frames.size()];
    const std::string name = timed.file.string();
    TriangleSurface read = read_surface(timed.file, scale);
    read.points = given.data.correction.corrected(read.points);
    CheckedSurface checked = checked_surface(name, std::move(read));
    check_size(name, checked.surface, lumen, given.unit);
    open_ends(checked, openings);
    const bool must_be_near = &timed == &files.back() && best < least_share;
    best = std::max(best, checked_placing(name, checked, lumen, reach, must_be_near));
    for (const std::string& note : checked.notes) notes.push_back(timed.file.filename().string() + ": " + note);
    held_out.push_back(holds(given.data.held_out, label));
    frames.push_back({timed.time, std::move(checked.surface), std::move(checked.flawed), label});
  }
  check_range(frames.front().time, frames.back().time, period, place);
  return std::make_unique<SurfaceSeries>(settings_of(given.data, period, lumen, place), std::move(frames), held_out,
                                         lumen, std::move(notes));
}

/// In space, those of the first frame of each track.
Points points_of(const std::vector<ContourTrack>& tracks) {
  Points all(3, 0);
  for (const ContourTrack& track : tracks)
    for (const auto& p : track.contours.front().points().colwise()) {
      all.conservativeResize(3, all.cols() + 1);
      all.rightCols(1) = track.plane.origin + track.plane.lifted(p);
    }
  return all;
}

/// The share of a frame's samples within reach, of those that face its contour; nothing if none does.
std::optional<double> share_within(const std::vector<Sample>& samples, double reach) {
  int facing = 0, near = 0;
  for (const Sample& sample : samples) {
    if (sample.excluded == Exclusion::missed || sample.excluded == Exclusion::rim) continue;
    ++facing;
    if (std::abs(sample.distance) <= reach) ++near;
  }
  if (facing == 0) return std::nullopt;
  return static_cast<double>(near) / facing;
}

/// The same power of ten between closed contours and the model's cuts in all slices is a unit.
int common_power(const ContourSeries& series, const LumenSurface& lumen) {
  std::optional<int> common;
  for (std::size_t t = 0; t < series.tracks().size(); ++t) {
    const Contour& contour = series.tracks()[t].contours.front();
    const double cut = series.cut_length(lumen.points, t);
    if (!contour.closed() || !(cut > 0)) continue;
    const int power = power_of_ten(contour.length() / cut);
    if (common && *common != power) return 0;
    common = power;
  }
  return common.value_or(0);
}

/// Throws InputError if the contours are elsewhere, or in another unit. Notes of slices that are far from the model.
std::vector<std::string> check_overlap(const ContourSeries& series, const LumenSurface& lumen, double reach,
                                       const SlicesCase& given) {
  const auto refused = [&](const std::string& why) {
    return input_error("{}: does not overlap the model: {}; {}", given.file.string(), why,
                       placement(points_of(series.tracks()), lumen.points));
  };
  if (const int power = common_power(series, lumen); power != 0)
    throw refused("its contours are " + guessed_unit(power, given.unit));
  std::vector<std::optional<double>> best(series.tracks().size());
  std::vector<std::pair<Frame, double>> far;
  for (const Frame& frame : series.frames())
    if (const auto share = share_within(series.observe(lumen.points, frame), reach)) {
      auto& of_track = best[static_cast<std::size_t>(frame.series)];
      of_track = std::max(of_track.value_or(0), *share);
      if (*share < least_share) far.emplace_back(frame, *share);
    }
  const auto most = *std::max_element(best.begin(), best.end());
  if (!most) throw refused("no slice cuts the model's lumen");
  if (*most < least_share) throw refused(share_text(*most, reach) + ", at least half must in one frame");
  std::vector<std::string> notes;
  for (std::size_t t = 0; t < best.size(); ++t)
    if (best[t] && *best[t] < least_share)
      notes.push_back(fmt::format("{}: at most {}", series.tracks()[t].name, share_text(*best[t], reach)));
  for (const auto& [frame, share] : far)
    if (const auto t = static_cast<std::size_t>(frame.series); *best[t] >= least_share)
      notes.push_back(
          fmt::format("{} at {:.4g}: only {}", series.tracks()[t].name, frame.time, share_text(share, reach)));
  return notes;
}

std::unique_ptr<LumenSeries> load(const SlicesCase& given, const LumenSurface& lumen, const Place& place) {
  std::vector<std::string> notes;
  note_corrections(notes, given.data, place.file);
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
  for (std::string& note : check_overlap(*series, lumen, reach_of(given.data, lumen), given))
    series->note(std::move(note));
  return series;
}

/// Some place where a velocity was measured must lie in the imaged lumen; how many do not is noted.
void check_overlap(const VelocitySeries& series, const SignedSurface& lumen, const CaseFile& file,
                   std::vector<std::string>& notes) {
  const std::vector<Closest> found = lumen.closest(series.points());
  const auto outside = std::count_if(found.begin(), found.end(), [](const Closest& c) { return c.distance < 0; });
  const std::string said = fmt::format("{} of {} points lie outside the imaged lumen", outside, found.size());
  if (outside == static_cast<std::ptrdiff_t>(found.size()))
    throw input_error("{}: does not overlap the model: {}; {}",
                      file.where("observations.velocities." + series.settings().name), said,
                      placement(series.points(), lumen.surface().points));
  if (outside > 0)
    notes.push_back(fmt::format("{}: {}: nothing is observed there while the lumen does not reach them",
                                series.settings().name, said));
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
  all.insert(all.end(), flow_notes.begin(), flow_notes.end());
  return all;
}

std::uint64_t Observations::content() const {
  std::uint64_t hash = 0;
  for (const auto& series : lumen) {
    const std::uint64_t content = series->content();
    hash = hash_bytes(&content, sizeof content, hash);
  }
  for (const Trace& trace : traces) hash = hash_values(trace.values, hash_values(trace.times, hash));
  return hash;
}

Observations load_observations(const ObservationsCase& given, const LumenSurface& lumen, const CaseFile& file) {
  Observations result{load_flow_observations(given, file), {}, {}};
  for (const auto& [name, source] : given.surfaces)
    result.lumen.push_back(load(source, lumen, {file, "observations.surfaces." + name}));
  for (const auto& [name, source] : given.contours)
    result.lumen.push_back(load(source, lumen, {file, "observations.contours." + name}));
  if (result.velocities.empty()) return result;
  const SignedSurface closed(closed_by_fans(lumen));
  for (const VelocitySeries& series : result.velocities) check_overlap(series, closed, file, result.flow_notes);
  return result;
}

}  // namespace tether
