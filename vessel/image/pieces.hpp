#pragma once

#include <optional>
#include <vector>

#include "vessel/image/image_volume.hpp"

namespace tether {

/// Parts of a field where it is positive that are not wanted.
struct DroppedPieces {
  int count = 0;
  Vec3 place = Vec3::Zero();  ///< a voxel of the largest [cm]
  double volume = 0;          ///< of all [cm3]
};

/// Makes a field negative wherever it is positive but does not hang together, voxel face on voxel face, with one of
/// the seeds; without seeds, with the largest such part. The zero surface of what is kept does not move.
DroppedPieces keep_pieces(ImageVolume& field, const std::vector<std::size_t>& seeds);

}  // namespace tether
