#pragma once

#include "diagnosis/comparison/discrepancy.hpp"
#include "observation_manager/measurements/plane_cut.hpp"

namespace tether {

/// Lines of points in space, one column each; a closed one ends with its first point.
using Lines = std::vector<Points>;

/// Model and data in one plane at one moment.
struct SliceView {
  std::string name;  ///< of the contour, or of the plane
  SlicePlane plane;
  Lines model, imaged, data;    ///< the run's lumen, the imaged lumen, the measurement
  std::vector<Sample> samples;  ///< of a contour: where distances were taken; of surfaces none
};

/// Of contours the plane of each that has a frame at the moment; of surfaces three planes across the vessel, at a
/// quarter, a half and three quarters of its length.
std::vector<SliceView> slices_at(const Moment& moment, const LumenSeries& data, const LumenSurface& lumen,
                                 const RunMotion& run);

/// The moments worth looking at: of the largest root mean square, and of the largest measured lumen. Null without
/// moments.
const Moment* worst_moment(const SourceDiscrepancy& source);
const Moment* fullest_moment(const SourceDiscrepancy& source);

/// The signed distance at each node of the run's lumen at a moment: NaN where no sample says anything.
VectorXd distance_at_nodes(const Moment& moment, const LumenSeries& data, const RunMotion& run);

}  // namespace tether
