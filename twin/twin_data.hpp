#pragma once

#include <functional>

#include "common/base/units.hpp"
#include "observation_manager/measurements/signed_surface.hpp"
#include "twin/twin_case.hpp"

namespace tether {

/// The lumen of the run that data are made from.
struct TrueLumen {
  std::vector<Triangle> triangles;
  std::function<Points(double)> positions;  ///< at a time of the run [length]
  double start = 0, end = 0;                ///< of the run [time]
};

/// A surface as a segmenter would hand it over.
struct TwinFrame {
  int number = 0;   ///< among all frames, lost ones too
  double time = 0;  ///< as stated; a mistimed frame shows another moment [time]
  TriangleSurface surface;
};

struct TwinFrames {
  std::vector<TwinFrame> frames;  ///< that are not lost
  double image_error =
      0;  ///< root mean square distance of the surfaces from the truth before noise and faults [length]
};

/// Where a field of the case stands: "case.yaml:9: twin.image.voxel".
using WhereInCase = std::function<std::string(const std::string& field)>;

/// Throws InputError for an image, noise or traces that cannot be made: more voxels or values than there is memory
/// for, or voxels, a blur or a noise larger than the vessel. first: time of the first frame.
void check_scales(const TwinCase& given, const UnitSystem& units, const TrueLumen& truth, double first,
                  const WhereInCase& where);

/// The stated times of all frames.
std::vector<double> times_of_frames(const TwinCase& given, const TrueLumen& truth);

/// Images, segments and spoils the truth. Throws InputError, beginning with `where`, for a frame outside the run, a
/// fault of a frame that does not exist or an image that shows nothing.
TwinFrames make_frames(const TwinCase& given, const UnitSystem& units, const TrueLumen& truth,
                       const std::string& where);

/// A trace of the run as measured: its values at every interval of the last beat, with noise.
struct TwinTrace {
  std::vector<double> times, values;
};
TwinTrace make_trace(const TwinTraceCase& given, const std::vector<double>& times, const std::vector<double>& values,
                     double first, std::uint64_t seed);

}  // namespace tether
