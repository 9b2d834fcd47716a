#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "observation_manager/measurements/contour_file.hpp"
#include "observation_manager/measurements/lumen_kinds.hpp"
#include "observation_manager/measurements/lumen_source.hpp"
#include "observation_manager/measurements/surface_check.hpp"

namespace tether {
namespace {

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
std::vector<Note> check_overlap(const ContourSeries& series, const LumenSurface& lumen, double reach,
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
  std::vector<Note> notes;
  for (std::size_t t = 0; t < best.size(); ++t)
    if (best[t] && *best[t] < least_share)
      notes.push_back({series.tracks()[t].name, "at most " + share_text(*best[t], reach)});
  for (const auto& [frame, share] : far)
    if (const auto t = static_cast<std::size_t>(frame.series); *best[t] >= least_share)
      notes.push_back(
          {fmt::format("{} at {:.4g}", series.tracks()[t].name, frame.time), "only " + share_text(share, reach)});
  return notes;
}

std::unique_ptr<LumenSeries> load(const SlicesCase& given, const LumenSurface& lumen, const LumenSource& source) {
  std::vector<Note> notes;
  note_corrections(notes, given.data, source.file);
  std::vector<ContourTrack> tracks = read_contour_tracks(given, source.file.units(), notes);
  const double period = given.beat.value_or(given.period.value_or(0));
  double first = infinite, last = -infinite;
  for (const ContourTrack& track : tracks) {
    first = std::min(first, track.times.front()), last = std::max(last, track.times.back());
    if (std::count(track.held_out.begin(), track.held_out.end(), false) == 0)
      throw input_error("{}: all frames of {}: one at least must be left to the model", source.where("held_out"),
                        track.name);
  }
  check_range(first, last, period, source);
  auto series = std::make_unique<ContourSeries>(settings_of(given.data, period, lumen, source), std::move(tracks),
                                                given.samples, lumen, std::move(notes));
  for (Note& note : check_overlap(*series, lumen, reach_of(given.data, lumen), given)) series->note(std::move(note));
  return series;
}

}  // namespace

void load_contours(const KindSection& section, const LumenSurface& lumen, const CaseFile& file, Observations& to) {
  for (const auto& [name, source] : sources_of<SlicesCase>(section))
    to.lumen.push_back(load(source, lumen, {file, "observations.contours." + name}));
}

}  // namespace tether
