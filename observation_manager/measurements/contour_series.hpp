#pragma once

#include "observation_manager/measurements/contour.hpp"
#include "observation_manager/measurements/lumen_series.hpp"
#include "observation_manager/measurements/registry.hpp"
#include "observation_manager/measurements/stations.hpp"

namespace tether {

/// One measured contour over time, in a slice that stays where it is.
struct ContourTrack {
  std::string name;  ///< of slice and contour, for reports
  SlicePlane plane;
  std::vector<double> times;        ///< ascending [time]
  std::vector<Contour> contours;    ///< one a time, in the plane's coordinates; a closed one counterclockwise
  std::vector<bool> held_out = {};  ///< empty: none
  std::vector<double> labels = {};  ///< numbers by which the case names the frames; empty: from 0
};

/// Contours in slices over time (cine images). The model's surface is cut by the slice's plane, and compared in that
/// plane: motion through the plane is neither seen nor invented. Each contour has the same number of samples at all
/// times, at equal distances along the cut (O.6).
class ContourSeries : public LumenSeries {
 public:
  /// An open contour is turned so that the imaged `lumen` lies on its left. A track whose plane misses the imaged lumen
  /// is noted.
  ContourSeries(SourceSettings settings, std::vector<ContourTrack> tracks, int samples_per_contour,
                const LumenSurface& lumen, std::vector<Note> notes = {});

  std::vector<Sample> observe(const Points& x, double time) const override;
  std::vector<Sample> observe(const Points& x, const Frame& frame) const override;
  std::vector<Frame> frames() const override;
  std::vector<std::string> series_names() const override;
  int sample_dimension() const override { return 1; }
  const MeasurementKind& kind() const override { return kinds::contours; }
  const SourceSettings& settings() const override { return settings_; }
  std::uint64_t content() const override;
  const std::vector<Note>& notes() const override { return notes_; }
  const std::vector<ContourTrack>& tracks() const { return tracks_; }
  /// Of the piece of the lumen at x that a track is compared with; 0 if its plane misses it [length].
  double cut_length(const Points& x, std::size_t track) const;
  void note(Note what) { notes_.push_back(std::move(what)); }

 private:
  std::vector<CutStation> stations(const Points& x, std::size_t track) const;
  Sample sample(const CutStation& station, std::size_t track, std::size_t frame) const;
  Sample unobserved(std::size_t track, Exclusion why) const;
  double observed_length(std::size_t track, const LumenSurface& lumen) const;
  void orient(std::size_t track, const LumenSurface& lumen);

  SourceSettings settings_;
  std::vector<ContourTrack> tracks_;
  std::vector<FrameTimes> times_;
  std::vector<double> length_;
  int samples_;
  std::vector<Triangle> triangles_;
  std::vector<Note> notes_;
};

}  // namespace tether
