#pragma once

#include "diagnosis/noise/noise_field.hpp"
#include "diagnosis/results/noise.hpp"
#include "observation_manager/measurements/noise.hpp"

namespace tether {

/// Whether some field has enough more data than columns.
bool can_be_measured(const std::vector<NoiseField>& fields);

/// Deviation, correlation length, nugget and shape of what is seen of errors, with 95 % intervals, and the correlation
/// time where there are three frames of the same places at least. stated: held against it, where a deviation and a
/// length are given. most: data of a frame that are used, drawn from all; the work grows with its cube, and less where
/// there are many fields. Throws RunError if it cannot be measured. (D.23)
MeasuredNoise measured_noise(const std::vector<NoiseField>& fields, const Noise& stated, Eigen::Index most = 600);

/// What a datum's errors have in common with those of the same place at other moments.
struct LastingErrors {
  MeasuredNumber time;        ///< in which they fade to a share 1/e [time]
  double p_of_stated = 1;     ///< probability that errors of the stated time look so much like others
  double frames_claimed = 1;  ///< independent frames by what is stated, over those by what is measured
};

/// Of one spatial correlation; none with fewer than three frames of the same places. stated: the time that is [time].
std::optional<LastingErrors> lasting_errors(const std::vector<NoiseField>& fields, const NoiseFit& fit, double stated);

/// Products of what is left of the values once the columns are fitted, by distance, and what the two fits expect there.
std::vector<CorrelationBin> correlation_by_distance(const std::vector<NoiseField>& fields,
                                                    const std::vector<NoiseFit>& fits);

}  // namespace tether
