#include "observation_manager/measurements/contour_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "common/base/checked_file.hpp"

namespace tether {
namespace {

/// Mean distance from a contour's points to the nearest point of a piece.
double separation(const Contour& contour, const CutPiece& piece, const SlicePlane& plane) {
  Eigen::Matrix2Xd places(2, piece.points.cols());
  for (Eigen::Index i = 0; i < places.cols(); ++i) places.col(i) = plane.flat(piece.points.col(i));
  double sum = 0;
  for (const auto& p : contour.points().colwise()) sum += (places.colwise() - p).colwise().norm().minCoeff();
  return sum / static_cast<double>(contour.points().cols());
}

}  // namespace

ContourSeries::ContourSeries(SourceSettings settings, std::vector<ContourTrack> tracks, int samples_per_contour,
                             const LumenSurface& lumen, std::vector<Note> notes)
    : settings_(std::move(settings)),
      tracks_(std::move(tracks)),
      samples_(samples_per_contour),
      triangles_(lumen.triangles),
      notes_(std::move(notes)) {
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const ContourTrack& track = tracks_[t];
    times_.emplace_back(track.times, settings_.period, settings_.time_tolerance, track.held_out);
    length_.push_back(observed_length(t, lumen));
    orient(t, lumen);
  }
}

/// What all samples of a track stand for. Those beside an open contour's ends do not count, so there it is the length
/// of the model's cut, as long as that is.
double ContourSeries::observed_length(std::size_t t, const LumenSurface& lumen) const {
  const std::vector<Contour>& contours = tracks_[t].contours;
  const bool closed = std::all_of(contours.begin(), contours.end(), [](const Contour& c) { return c.closed(); });
  if (const double cut = closed ? 0 : cut_length(lumen.points, t); cut > 0) return cut;
  double length = 0;
  for (const Contour& contour : contours) length += contour.length();
  return length / static_cast<double>(contours.size());
}

void ContourSeries::orient(std::size_t t, const LumenSurface& lumen) {
  ContourTrack& track = tracks_[t];
  const std::vector<CutStation> places = stations(lumen.points, t);
  if (places.empty()) notes_.push_back({track.name, "its plane misses the imaged lumen"});
  for (Contour& contour : track.contours) {
    if (contour.closed()) continue;
    double agreement = 0;
    for (const CutStation& s : places) {
      const ClosestInPlane c = contour.closest(track.plane.flat(s.position));
      if (!c.at_end) agreement += c.pseudonormal.dot(s.normal);
    }
    if (agreement < 0) contour = contour.reversed();
  }
}

std::vector<CutStation> ContourSeries::stations(const Points& x, std::size_t t) const {
  const ContourTrack& track = tracks_[t];
  const std::vector<CutPiece> pieces = cut_by_plane(x, triangles_, track.plane);
  if (pieces.empty()) return {};
  const CutPiece* best = &pieces.front();
  if (pieces.size() > 1) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const CutPiece& piece : pieces)
      if (const double apart = separation(track.contours.front(), piece, track.plane); apart < smallest)
        smallest = apart, best = &piece;
  }
  return stations_along(*best, track.plane, samples_);
}

double ContourSeries::cut_length(const Points& x, std::size_t t) const {
  const std::vector<CutStation> places = stations(x, t);
  if (places.size() < 2) return 0;
  double length = 0;  // of all parts but two halves
  for (std::size_t i = 1; i < places.size(); ++i) length += (places[i].position - places[i - 1].position).norm();
  const auto count = static_cast<double>(places.size());
  return length * count / (count - 1);
}

Sample ContourSeries::unobserved(std::size_t track, Exclusion why) const {
  Sample sample;
  sample.series = static_cast<int>(track);
  sample.excluded = why;
  return sample;
}

Sample ContourSeries::sample(const CutStation& station, std::size_t t, std::size_t frame) const {
  const SlicePlane& plane = tracks_[t].plane;
  const ClosestInPlane found = tracks_[t].contours[frame].closest(plane.flat(station.position));
  Eigen::Index main = 0;
  station.place.shares.maxCoeff(&main);
  const auto node = static_cast<std::size_t>(station.place.nodes[static_cast<std::size_t>(main)]);
  Sample sample = unobserved(t, settings_.of_node[node]);
  sample.nodes = station.place.nodes;
  sample.shares = station.place.shares;
  sample.position = station.position;
  sample.distance = found.distance + settings_.outward;
  sample.normal = plane.lifted(found.normal);
  sample.region = settings_.region[node];
  if (sample.excluded == Exclusion::none && found.at_end) sample.excluded = Exclusion::rim;
  if (sample.excluded == Exclusion::none && std::abs(sample.distance) > settings_.trust_distance)
    sample.excluded = Exclusion::too_far;
  if (sample.excluded == Exclusion::none) sample.weight = length_[t] / samples_;  // (O.6)
  return sample;
}

std::vector<Sample> ContourSeries::observe(const Points& x, double time) const {
  std::vector<Sample> samples;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const std::vector<FrameShare> shares = times_[t].at(time);
    const std::vector<CutStation> places = shares.empty() ? std::vector<CutStation>{} : stations(x, t);
    if (places.empty()) {
      const Sample none = unobserved(t, shares.empty() ? Exclusion::no_frame : Exclusion::missed);
      samples.insert(samples.end(), static_cast<std::size_t>(samples_), none);
      continue;
    }
    std::vector<Sample> of_frames(shares.size());
    for (const CutStation& station : places) {
      for (std::size_t i = 0; i < shares.size(); ++i) of_frames[i] = sample(station, t, shares[i].frame);
      samples.push_back(between(of_frames, shares));
    }
  }
  return samples;
}

std::vector<Sample> ContourSeries::observe(const Points& x, const Frame& frame) const {
  const auto t = static_cast<std::size_t>(frame.series);
  const std::vector<CutStation> places = stations(x, t);
  if (places.empty()) return std::vector(static_cast<std::size_t>(samples_), unobserved(t, Exclusion::missed));
  std::vector<Sample> samples;
  for (const CutStation& station : places) samples.push_back(sample(station, t, frame.number));
  return samples;
}

std::vector<std::string> ContourSeries::series_names() const {
  std::vector<std::string> names;
  for (const ContourTrack& track : tracks_) names.push_back(track.name);
  return names;
}

std::uint64_t ContourSeries::content() const {
  std::uint64_t hash = 0;
  if (settings_.outward != 0) hash = hash_bytes(&settings_.outward, sizeof settings_.outward, hash);
  for (const ContourTrack& track : tracks_) {
    for (const Vec3& part : {track.plane.origin, track.plane.e1, track.plane.e2}) hash = hash_values(part, hash);
    hash = hash_values(track.times, hash);
    for (const Contour& contour : track.contours) hash = hash_values(contour.points(), hash);
  }
  return hash;
}

std::vector<Frame> ContourSeries::frames() const {
  std::vector<Frame> frames;
  for (std::size_t t = 0; t < tracks_.size(); ++t)
    for (std::size_t i = 0; i < tracks_[t].times.size(); ++i)
      frames.push_back({static_cast<int>(t), i, tracks_[t].times[i], times_[t].held_out(i),
                        tracks_[t].labels.empty() ? static_cast<double>(i) : tracks_[t].labels[i]});
  return frames;
}

}  // namespace tether
