#pragma once

#include "diagnosis/comparison/run_motion.hpp"
#include "diagnosis/noise/noise_field.hpp"
#include "diagnosis/results/noise.hpp"
#include "observation_manager/measurements/observations.hpp"
#include "observation_manager/measurements/triangle_surface.hpp"

namespace tether {

/// What data show of their errors, in one of three ways.
struct SeenNoise {
  NoiseOrigin from = NoiseOrigin::residual;
  std::string source;               ///< "observations.surfaces.mri", or two of them
  std::vector<std::string> frames;  ///< that were used
  Noise stated;
  std::vector<NoiseField> fields;
  std::vector<double> apart = {};  ///< of the frames of each pair that is at rest [time]
};

/// Of two sources of one kind, frames of the same time: half of the difference's variance is the noise's, of both in
/// the mean.
std::vector<SeenNoise> repeated_noise(const Observations& data, const RunMotion& run);

/// Neighbouring frames of a source between which the model's lumen moves less than the noise that is stated (without
/// one: than the frames differ), each frame in one pair; its motion is left free. Errors that last look smaller.
std::vector<SeenNoise> noise_at_rest(const Observations& data, const RunMotion& run);

/// What the run leaves, an offset, a shift and a slope along the vessel free in each frame, and the size and the time
/// of the model's motion in all of them together. It holds what the model does wrong too.
std::vector<SeenNoise> residual_noise(const Observations& data, const RunMotion& run);

/// Two surfaces of one moment, at the points of the first, those beside a rim left out. Throws InputError if they are
/// the same surface, or farther apart than two segmentations can be.
SeenNoise noise_between(const TriangleSurface& first, const TriangleSurface& second);

}  // namespace tether
