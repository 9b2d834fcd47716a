#pragma once

#include "observation_manager/measurements/signed_surface.hpp"

namespace tether {

/// An image: a value for each voxel, x fastest.
struct VoxelImage {
  Vec3 origin, spacing;  ///< middle of the first voxel, size of a voxel [length]
  std::array<int, 3> count{};
  std::vector<float> values;
};

/// How much of each voxel lies within a closed surface, from 0 to 1, with a rim of empty voxels about it (T.3). Middles
/// of voxels lie at `shift` and whole multiples of `spacing` from it. Exact along z; `lines`: probes across a voxel in
/// x and in y.
VoxelImage coverage(const TriangleSurface& closed, const Vec3& spacing, const Vec3& shift, double rim, int lines = 4);

/// The surface between inside and outside as a segmenter draws it: the image blurred by a Gaussian of that deviation,
/// voxels that are more than half inside marked, marching cubes around them, and steps of the voxels smoothed away.
struct Segmentation {
  double blur = 0;     ///< standard deviation [length]
  bool mask = true;    ///< false: the level 1/2 of the grey values themselves
  int smoothing = 30;  ///< passes of a windowed sinc filter; 0: none
};
TriangleSurface segmented(const VoxelImage& image, const Segmentation& how);

}  // namespace tether
