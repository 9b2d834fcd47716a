#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/base/units.hpp"
#include "observation_manager/measurements/frame_sequence.hpp"
#include "observation_manager/measurements/kind.hpp"
#include "observation_manager/measurements/measured_run.hpp"
#include "observation_manager/measurements/noise.hpp"

namespace tether {

/// A frame of a source: one surface, one contour, one plane of velocities.
struct Frame {
  int series = 0;  ///< number of the contour within its source; else 0
  std::size_t number = 0;
  double time = 0;
  bool held_out = false;
  double label = 0;  ///< number by which the case names it: `number` counts those only that are used
};

/// Data of one moment. A record is all of a source, over the run: its values belong to the phase of the beat that the
/// frame closest to each shows, with all that was measured in it.
struct MeasuredPart {
  Frame frame;
  double time = 0;  ///< in the run
  bool is_record = false;
};

/// One measured number beside a run's.
struct Datum {
  double residual = 0;     ///< measured minus the run's [unit of the source]; means nothing unless it is seen
  bool is_seen = true;     ///< whether this run has anything to set against it
  double independent = 0;  ///< how many independent data it is (K.5); 0 if it is none
  double time = 0;         ///< in the run
  bool held_out = false;
  double shown = 0;            ///< by an instrument: the value as it stands there [unit of the source]
  int component = 0;           ///< of a vector: each errs by itself
  std::array<int, 4> patch{};  ///< data of one patch of a part err together
  Vec3 position{0, 0, 0};      ///< [length]
  // on the lumen only
  int region = -1;       ///< of the wall
  Vec3 normal{0, 0, 0};  ///< out of the lumen
  Triangle nodes{};      ///< that carry the place
  Vec3 shares{0, 0, 0};  ///< of these nodes
};

/// Frames or values that follow each other, each of which a filter that looks at every step counts once. (K.5)
struct CountedSeries {
  std::vector<double> times;  ///< ascending, of what is not held out; one NaN: a frame that always holds
  double period = 0, tolerance = 0, correlation_time = 0;
  double precision = 0;                  ///< of a row of weight 1 in one frame
  FrameCurve curve = FrameCurve::cubic;  ///< that rows between frames are made by
};

/// The rows of a source as a filter sees them at every step, always as many.
struct CountedRows {
  std::vector<CountedSeries> series;
  std::vector<std::size_t> series_of;  ///< of each row
  std::vector<std::string> groups;     ///< rows that a reader wants together: contours
  std::vector<int> region;             ///< of each row; -1: none
  std::vector<std::size_t> group_of;   ///< of each row
  Points positions;                    ///< of each row, in the image; no columns if they have none [length]
  Points normals = Points(3, 0);       ///< of each row on the lumen, out of it, in the image; else no columns
};

/// A row at a time: measured minus the model's.
struct SeenRow {
  double difference = 0, weight = 0;  ///< weight: area or length on the lumen, else 1; 0: no datum
};

/// A column of timeseries.csv that a source is compared with.
struct NeededColumn {
  std::string name, field;  ///< field of the case that says so: "observable"
  Dimension dimension;
};

/// What every measurement can say of itself.
struct MeasurementFacts {
  const MeasurementKind& kind;
  std::string name;
  Noise noise;
  Dimension dimension;    ///< of its values
  bool held_out = false;  ///< all of it: it judges the model, and is not used to make it
  std::string field() const { return "observations." + kind.name + "." + name; }
};

/// One source of measurements, of whatever kind.
class Measurement {
 public:
  virtual ~Measurement() = default;
  virtual MeasurementFacts facts() const = 0;
  /// A hash of what was measured, as it was read: names the data, wherever their files lie.
  virtual std::uint64_t content() const = 0;

  // What it asks of a run, which must know it before it begins.
  virtual std::vector<NeededColumn> columns() const { return {}; }
  virtual Points velocity_points() const { return Points(3, 0); }

  // Beside a finished run.
  /// What of it the run reaches, held out or not.
  virtual std::vector<MeasuredPart> parts(const FinishedMotion& run) const = 0;
  /// Always as many, in the same order, whatever the run does in the same time.
  virtual std::vector<Datum> data(const FinishedMotion& run, const MeasuredPart& part) const = 0;

  // At every step of a model, held-out data left out.
  /// imaged: the lumen's nodes. start: of the run.
  virtual CountedRows rows(const Points& imaged, double start) const = 0;
  virtual std::vector<SeenRow> see(const ModelMoment& model, double time) const = 0;
};

}  // namespace tether
