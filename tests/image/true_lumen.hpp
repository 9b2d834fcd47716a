#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "observation_manager/measurements/signed_surface.hpp"
#include "twin/closed_lumen.hpp"
#include "vessel/mesh_file.hpp"
#include "vessel/surface/rims.hpp"

namespace tether::testing {

/// A lumen, and its surface closed behind its ends.
struct Truth {
  std::size_t triangles = 0;  ///< of the lumen itself: those behind come after
  TriangleSurface closed;
};

inline Truth truth_of(const RawSurface& open) {
  const TriangleSurface lumen{open.points, open.triangles};
  return {lumen.triangles.size(), closed_lumen(lumen, 1.5)};
}

inline Truth arch(const std::string& source) {
  const MeshFile file = read_mesh_file(source + "/data/aortic_arch_adult/arch_surface.vtp");
  RawSurface surface{0.1 * file.points, file.triangles, {}};
  for (const auto label : file.triangle_labels.at("ModelFaceID")) surface.face_id.push_back(static_cast<int>(label));
  open_labels(surface, {1, 2, 3, 4, 5});
  return truth_of(surface);
}

struct Off {
  double mean = 0, p95 = 0, greatest = 0, bias = 0;  ///< [voxels]
};

/// How far nodes of a surface are off the lumen, those beside the drawn-out ends left out.
inline Off off(const RawSurface& surface, const Truth& truth, double voxel) {
  const SignedSurface lumen(truth.closed);
  Off result;
  std::vector<double> distances;
  for (const Closest& c : lumen.closest(surface.points)) {
    if (c.triangle >= static_cast<int>(truth.triangles)) continue;
    distances.push_back(std::abs(c.distance) / voxel);
    result.mean += std::abs(c.distance) / voxel, result.bias -= c.distance / voxel;
  }
  const auto count = static_cast<double>(distances.size());
  std::sort(distances.begin(), distances.end());
  result.mean /= count, result.bias /= count;
  result.p95 = distances[static_cast<std::size_t>(0.95 * count)], result.greatest = distances.back();
  return result;
}

}  // namespace tether::testing
