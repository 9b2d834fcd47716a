#pragma once

#include "diagnosis/comparison/run_motion.hpp"
#include "diagnosis/noise/noise_field.hpp"
#include "observation_manager/measurements/lumen_series.hpp"

namespace tether {

/// A frame's distances to a lumen, sample by sample.
struct SeenFrame {
  Frame frame;
  double time = 0;  ///< in the run
  std::vector<Sample> samples;
};

/// A series' frames in the order of the run's times, where it lies in each.
struct SeenSeries {
  int series = 0;
  std::vector<SeenFrame> frames;
};

/// The lumen that a frame is held against.
using LumenAt = std::function<Points(double time)>;

/// All frames of a source that the run reaches, by series; each against the lumen at its time.
std::vector<SeenSeries> seen_series(const LumenSeries& data, const RunMotion& run, const LumenAt& lumen);

/// Numbers of the samples that all these frames have. Frames with less than half of the samples of the fullest are
/// taken off the list.
std::vector<std::size_t> common_samples(std::vector<SeenFrame>& frames);

/// Mean places and normals of these samples.
struct MeanPlaces {
  Points places, normals;
};
MeanPlaces mean_places(const std::vector<SeenFrame>& frames, const std::vector<std::size_t>& samples);

VectorXd distances(const SeenFrame& frame, const std::vector<std::size_t>& samples);

/// Of a field of vectors on the lumen's nodes, the part along the samples' normals.
VectorXd along_normals(const Points& nodal, const SeenFrame& frame, const std::vector<std::size_t>& samples);

}  // namespace tether
