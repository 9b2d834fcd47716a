#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "observation_manager/measurements/frame_times.hpp"
#include "observation_manager/measurements/lumen_surface.hpp"
#include "observation_manager/measurements/measurement.hpp"
#include "observation_manager/measurements/sample.hpp"

namespace tether {

/// What all sources of lumen data have in common.
struct SourceSettings {
  std::string name;
  double period = 0;                                                ///< 0: not periodic [time]
  double time_tolerance = 0;                                        ///< FrameTimes [time]
  double trust_distance = std::numeric_limits<double>::infinity();  ///< farther data are none [length]
  std::vector<Exclusion> of_node;                                   ///< of the lumen, none or why it is never observed
  std::vector<int> region;                                          ///< of the lumen's nodes
  Noise noise;
  double outward = 0;  ///< added to distances: the data are too far inward by it [length]
};

/// What was found of one file or contour, or of the whole source.
struct Note {
  std::string of;  ///< empty: the source
  std::string text;
};

/// What is said of several files in the same words, once: "lumen_0.stl and 9 more: ...".
std::vector<std::string> told(const std::vector<Note>& notes);

/// Measurements of the moving lumen: surfaces, or contours in slices.
class LumenSeries : public Measurement {
 public:
  /// The model's lumen at positions x, at a time between frames (O.3). Always the same number of samples in the same
  /// order, whatever x and time: what is not observed has weight 0 and says why. Held-out frames are not used.
  virtual std::vector<Sample> observe(const Points& x, double time) const = 0;
  /// The same against one frame, held out or not.
  virtual std::vector<Sample> observe(const Points& x, const Frame& frame) const = 0;
  virtual std::vector<Frame> frames() const = 0;
  virtual const MeasurementKind& kind() const = 0;
  /// Of its contours; of surfaces the one name of the source.
  virtual std::vector<std::string> series_names() const = 0;
  /// What a sample's weight is: 2 an area, 1 a length.
  virtual int sample_dimension() const = 0;
  virtual const SourceSettings& settings() const = 0;
  /// What was found and done on loading: data left out, surfaces turned, holes.
  virtual const std::vector<Note>& notes() const = 0;

  MeasurementFacts facts() const override;
  std::vector<MeasuredPart> parts(const FinishedMotion& run) const override;
  /// A datum for each sample.
  std::vector<Datum> data(const FinishedMotion& run, const MeasuredPart& part) const override;
  CountedRows rows(const Points& imaged, double start) const override;
  std::vector<SeenRow> see(const ModelMoment& model, double time) const override;
};

/// What is seen of a place between frames, of what each of them shows of it (O.3): excluded if it is in one of the two
/// around the time; by the chord of these two if it is in another.
Sample between(const std::vector<Sample>& of_frames, const std::vector<FrameShare>& shares);

}  // namespace tether
