#include "vessel/image/level_set.hpp"

#define ITK_IO_FACTORY_REGISTER_MANAGER_NONE
#include <itkGeodesicActiveContourLevelSetImageFilter.h>
#include <itkImage.h>

#include <algorithm>
#include <cmath>

#include "common/base/error.hpp"
#include "vessel/image/basins.hpp"
#include "vessel/image/edge_map.hpp"
#include "vessel/image/half_way.hpp"
#include "vessel/image/smooth_field.hpp"
#include "vessel/image/stops.hpp"

namespace tether {
namespace {

using Grey = itk::Image<float, 3>;
using Front = itk::GeodesicActiveContourLevelSetImageFilter<Grey, Grey>;

/// Part of an image: first and last voxel along each axis, which may lie beyond the image's.
struct Box {
  std::array<int, 3> low, high;
};

constexpr int beyond = 4;  // voxels, for the front's layers where it leaves the image

/// Around the voxels that are inside, with a margin; `beyond` the image where it would leave it.
Box box_around(const ImageVolume& image, const std::vector<char>& inside, int margin) {
  Box box{image.count, {-1, -1, -1}};
  for (std::size_t n = 0; n < inside.size(); ++n) {
    if (!inside[n]) continue;
    const std::array<int, 3> voxel = image.voxel(n);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(box.low[axis], voxel[axis]);
      box.high[axis] = std::max(box.high[axis], voxel[axis]);
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::max(box.low[axis] - margin, -beyond);
    box.high[axis] = std::min(box.high[axis] + margin, image.count[axis] - 1 + beyond);
  }
  return box;
}

/// A voxel of a box, and the nearest of the image.
struct BoxVoxel {
  std::size_t number, of_image;
  bool in_image, at_side;  ///< whether the image has it, whether it is the box's last before others of the image
};
template <class Visit>
void for_each(const Box& box, const ImageVolume& image, Visit visit) {
  BoxVoxel voxel{};
  std::array<int, 3> at{}, nearest{};
  for (at[2] = box.low[2]; at[2] <= box.high[2]; ++at[2])
    for (at[1] = box.low[1]; at[1] <= box.high[1]; ++at[1])
      for (at[0] = box.low[0]; at[0] <= box.high[0]; ++at[0]) {
        voxel.at_side = false;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          nearest[axis] = std::clamp(at[axis], 0, image.count[axis] - 1);
          voxel.at_side = voxel.at_side || ((at[axis] == box.low[axis] || at[axis] == box.high[axis]) &&
                                            nearest[axis] > 0 && nearest[axis] < image.count[axis] - 1);
        }
        voxel.in_image = at == nearest, voxel.of_image = image.at(nearest[0], nearest[1], nearest[2]);
        visit(voxel);
        ++voxel.number;
      }
}

/// Its voxels are cubes of side 1, whatever the image's are: weights do not depend on the image's size, and walls, some
/// voxels wide along each axis, hold a front alike whichever way they face.
Grey::Pointer empty_image(const Box& box) {
  const auto image = Grey::New();
  Grey::SizeType size;
  for (unsigned axis = 0; axis < 3; ++axis)
    size[axis] = static_cast<itk::SizeValueType>(box.high[axis] - box.low[axis]) + 1;
  image->SetRegions(size);
  image->Allocate();
  return image;
}

/// Ends a front once what it encloses, averaged over some steps, does not change any more: single steps go to and fro.
/// So it does where it grows faster again after it had all but stood still: it has found a way through the wall.
class Stillness {
 public:
  Stillness(Front& front, bool& grew_again) : front_(front), grew_again_(grew_again) {}
  void operator()(const itk::EventObject&) {
    const Grey& height = *front_.GetOutput();
    const float* first = height.GetBufferPointer();
    sum_ += static_cast<double>(std::count_if(first, first + height.GetLargestPossibleRegion().GetNumberOfPixels(),
                                              [](float value) { return value < 0; }));
    if (front_.GetElapsedIterations() % window != 0) return;
    const double mean = sum_ / window, change = mean - before_;
    least_ = std::min(least_, std::max(change, few));
    grew_again_ = least_ < slow * mean && change > faster * least_;
    if (grew_again_ || std::abs(change) < still * mean + few)
      front_.SetNumberOfIterations(front_.GetElapsedIterations());
    before_ = mean, sum_ = 0;
  }

 private:
  static constexpr int window = 20;      // steps
  static constexpr double few = 5;       // voxels
  static constexpr double still = 1e-3;  // a vessel of five voxels that is being filled grows more than that
  static constexpr double slow = 5e-3, faster = 1.5;  // leaks of the benchmark's chests; what is filled grows evenly
  Front& front_;
  bool& grew_again_;
  double sum_ = 0, before_ = 0, least_ = infinite;
};

/// Where it is pushed outward by how even the image is, and drawn to where it is least even. `step`: of a voxel, at
/// most.
/// `grew_again`: whether that ended it.
Front::Pointer moved(Grey* start, Grey* evenness, double outward, double step, const LevelSetCase& how,
                     bool& grew_again) {
  constexpr double attraction = 3;  // holds the front at an edge against a push of 1: (M.21)
  const auto front = Front::New();
  front->SetInput(start);
  front->SetFeatureImage(evenness);
  front->SetPropagationScaling(outward);
  front->SetCurvatureScaling(how.curvature);
  front->SetAdvectionScaling(attraction);
  front->SetDerivativeSigma(0.5);
  front->SetMaximumRMSError(0);
  front->SetNumberOfIterations(static_cast<unsigned>(how.iterations));
  dynamic_cast<itk::LevelSetFunction<Grey>&>(*front->GetSegmentationFunction()).SetMaximumPropagationTimeStep(step);
  front->AddObserver(itk::IterationEvent(), Stillness(*front, grew_again));
  front->Update();
  return front;
}

/// What moves a front: where it begins, where it may not go, and how far from a wall's each place's change is.
struct Ground {
  std::vector<char> inside, barred;
  ImageVolume steepness;  ///< 1 at the wall's edge
  double edge = 0;        ///< [per cm]
  // what it is settled by
  ImageVolume grey;             ///< less smooth than what it is moved by
  double contrast = 0;          ///< of the wall
  std::vector<char> of_others;  ///< barred, or in a neighbour's basin
};

struct Settled {
  bool reaches_side = false;  ///< of the box
  LevelSet found;
};

/// The front in a box: grown with a push outward until it stands still, then settled without, by small steps.
Settled settled_in(const Box& box, const Ground& ground, const LevelSetCase& how) {
  const ImageVolume& image = ground.steepness;
  const auto start = empty_image(box), evenness = empty_image(box);
  for_each(box, image, [&](const BoxVoxel& voxel) {
    const double steepness = 2 * image.values[voxel.of_image];
    start->GetBufferPointer()[voxel.number] = ground.inside[voxel.of_image] ? -0.5F : 0.5F;
    evenness->GetBufferPointer()[voxel.number] =
        ground.barred[voxel.of_image] ? 0 : static_cast<float>(1 / (1 + steepness * steepness));  // (M.21)
  });
  Settled result{false, {image, 0, true, false, ground.edge}};
  bool settled_again = false;  // it shrinks
  const auto grown = moved(start, evenness, 1, 1.0 / 6, how, result.found.grew_again);
  const auto front = moved(grown->GetOutput(), evenness, 0, 0.08, how, settled_again);
  const auto steps = static_cast<int>(grown->GetElapsedIterations());
  result.found.iterations = steps + static_cast<int>(front->GetElapsedIterations());
  result.found.stood_still = steps < how.iterations && !result.found.grew_again;
  std::vector<float>& field = result.found.field.values;
  std::fill(field.begin(), field.end(), -1.0F);
  const float* height = front->GetOutput()->GetBufferPointer();
  for_each(box, image, [&](const BoxVoxel& voxel) {
    if (voxel.in_image) field[voxel.of_image] = -height[voxel.number];
    if (voxel.at_side && height[voxel.number] < 0) result.reaches_side = true;
  });
  return result;
}

/// The wall about the seeds. Throws InputError if there is none, or the seeds are not of one kind.
WallSeen wall_of(const ImageVolume& smooth, const LumenImageCase& how, const std::vector<std::size_t>& seeds) {
  const WallSeen wall = wall_around(smooth, gradient_magnitude(smooth), seeds);
  if (!(wall.edge > 0) || !(wall.contrast > 0))
    throw input_error("{}: the image does not change around the seeds", how.at("image.level_set"));
  constexpr double most_apart = 0.8;  // of the contrast: seeds in lumen and tissue are 1 apart
  if (wall.brightest - wall.darkest > most_apart * wall.contrast)
    throw input_error(
        "{}: lie in different things: {:.4g} at one, {:.4g} at another, while the wall's contrast about them is {:.4g}",
        how.at("image.seeds"), wall.darkest, wall.brightest, wall.contrast);
  return wall;
}

/// 1 in what the front may not enter.
std::vector<char> barred_in(const ImageVolume& smooth, const LumenImageCase& how) {
  std::vector<char> barred(smooth.values.size(), 0);
  if (how.threshold)
    for (std::size_t n = 0; n < barred.size(); ++n) barred[n] = !how.threshold->admits(smooth.values[n]);
  for_stops(smooth, how.stops, [&](std::size_t n, double outside) { barred[n] = barred[n] || outside < 0; });
  return barred;
}

/// The border of a basin becomes an edge as steep as the wall's. What is within is not barred: that would be a place
/// more uneven than any border, and draw the front across it.
void add_border(Ground& ground, ImageVolume basin) {
  for (std::size_t n = 0; n < basin.values.size(); ++n)
    if (basin.values[n] > 0) ground.inside[n] = 0;
  smooth_field(basin, 1);
  const ImageVolume border = gradient_magnitude(basin);
  const float most = *std::max_element(border.values.begin(), border.values.end());
  for (std::size_t n = 0; n < basin.values.size(); ++n)
    ground.steepness.values[n] = std::hypot(ground.steepness.values[n], border.values[n] / most);
}

Ground ground_of(const ImageVolume& image, const LumenImageCase& how, const std::vector<std::size_t>& seeds,
                 const std::vector<std::size_t>& neighbours) {
  const double deviation = how.smoothing.value_or(1);
  ImageVolume smooth = image;
  smooth_field(smooth, deviation);
  const WallSeen wall = wall_of(smooth, how, seeds);
  Ground ground;
  ground.barred = barred_in(smooth, how);
  smooth.values = image.values;
  clamp_values(smooth, wall);
  smooth_field(smooth, deviation);
  ground.steepness = gradient_magnitude(smooth);
  ground.edge = how.level_set->edge.value_or(wall_around(smooth, ground.steepness, seeds).edge);
  ground.of_others = ground.barred;
  ImageVolume basin;
  if (!neighbours.empty()) {
    basin = neighbours_basin(ground.steepness, seeds, neighbours);
    for (std::size_t n = 0; n < basin.values.size(); ++n)
      ground.of_others[n] = ground.of_others[n] || basin.values[n] > 0;
  }
  WallSeen sought = wall;
  sought.edge = ground.edge;
  ground.inside = flooded(smooth, ground.steepness, sought, seeds, ground.of_others);
  ground.contrast = wall.contrast;
  ground.grey = image;
  clamp_values(ground.grey, wall);
  smooth_field(ground.grey, how.smoothing.value_or(smoothing_of_grey));
  for (float& value : ground.steepness.values) value /= static_cast<float>(ground.edge);
  if (!neighbours.empty()) add_border(ground, std::move(basin));
  return ground;
}

}  // namespace

LevelSet level_set(const ImageVolume& image, const LumenImageCase& how, const std::vector<std::size_t>& seeds,
                   const std::vector<std::size_t>& neighbours) {
  const Ground ground = ground_of(image, how, seeds, neighbours);
  for (int margin = 16;; margin *= 4) {
    Settled settled = settled_in(box_around(image, ground.inside, margin), ground, *how.level_set);
    if (settled.reaches_side) continue;
    LevelSet& found = settled.found;
    move_half_way(found.field, ground.grey, ground.of_others, ground.contrast, ground.edge);
    return std::move(found);
  }
}

}  // namespace tether
