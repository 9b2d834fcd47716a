#include "vessel/image/edge_map.hpp"

#include <algorithm>
#include <cmath>

namespace tether {
namespace {

double lower_quartile(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto quarter = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4);
  std::nth_element(values.begin(), quarter, values.end());
  return *quarter;
}

/// A ray's values at places half a voxel apart, as far as the widest vessel's wall or the image's end.
struct Ray {
  std::vector<double> grey, change;
};
Ray ray_from(const ImageVolume& image, const ImageVolume& gradient, std::size_t seed, const Vec3& direction) {
  constexpr double widest = 4;  // [cm]
  Ray ray;
  const Vec3 start = image.place(seed);
  const double step = image.spacing.minCoeff() / 2;
  for (double s = 0; s < widest && image.holds(start + s * direction); s += step) {
    const std::size_t voxel = image.nearest(start + s * direction);
    ray.grey.push_back(image.values[voxel]), ray.change.push_back(gradient.values[voxel]);
  }
  return ray;
}

/// How many times lower than a ray's greatest change a peak may be, and the end of a peak than the peak.
constexpr double times_lower = 3;

/// The first peak of at least a third of the ray's greatest: noise within the lumen is lower, bone behind the wall not
/// often higher than three times. Behind it the grey value where the change has fallen to a third of the peak.
void see_wall(const Ray& ray, std::vector<double>& edges, std::vector<double>& contrasts) {
  if (ray.change.empty()) return;
  const double enough = *std::max_element(ray.change.begin(), ray.change.end()) / times_lower;
  for (std::size_t i = 1; i + 1 < ray.change.size(); ++i) {
    if (ray.change[i] < enough || ray.change[i + 1] >= ray.change[i]) continue;
    std::size_t behind = i;
    while (behind + 1 < ray.change.size() && ray.change[behind] > ray.change[i] / times_lower) ++behind;
    edges.push_back(ray.change[i]), contrasts.push_back(std::abs(ray.grey[behind] - ray.grey.front()));
    return;
  }
}

}  // namespace

ImageVolume gradient_magnitude(const ImageVolume& image) {
  ImageVolume result = image;
  const double side = image.spacing.minCoeff();
  const std::array<std::size_t, 3> stride{1, image.at(0, 1, 0), image.at(0, 0, 1)};
  for (std::size_t n = 0; n < image.values.size(); ++n) {
    const std::array<int, 3> voxel = image.voxel(n);
    double square = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t low = voxel[axis] > 0 ? n - stride[axis] : n;
      const std::size_t high = voxel[axis] + 1 < image.count[axis] ? n + stride[axis] : n;
      const std::size_t voxels_apart = (high - low) / stride[axis];
      const double slope = (image.values[high] - image.values[low]) / (side * static_cast<double>(voxels_apart));
      square += slope * slope;
    }
    result.values[n] = static_cast<float>(std::sqrt(square));
  }
  return result;
}

WallSeen wall_around(const ImageVolume& image, const ImageVolume& gradient, const std::vector<std::size_t>& seeds) {
  std::vector<double> edges, contrasts, greys;
  for (const std::size_t seed : seeds) {
    greys.push_back(image.values[seed]);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k)
          if (i != 0 || j != 0 || k != 0)
            see_wall(ray_from(image, gradient, seed, Vec3(i, j, k).normalized()), edges, contrasts);
  }
  const auto [darkest, brightest] = std::minmax_element(greys.begin(), greys.end());
  return {lower_quartile(edges), lower_quartile(contrasts), *darkest, *brightest};
}

void clamp_values(ImageVolume& image, const WallSeen& wall) {
  const auto low = static_cast<float>(wall.darkest - 1.5 * wall.contrast),
             high = static_cast<float>(wall.brightest + 1.5 * wall.contrast);
  for (float& value : image.values) value = std::clamp(value, low, high);
}

std::vector<char> flooded(const ImageVolume& image, const ImageVolume& gradient, const WallSeen& wall,
                          const std::vector<std::size_t>& seeds, const std::vector<char>& barred) {
  std::vector<char> inside(image.values.size(), 0);
  std::vector<std::size_t> border;
  const std::array<std::size_t, 3> stride{1, image.at(0, 1, 0), image.at(0, 0, 1)};
  for (const std::size_t seed : seeds) inside[seed] = 1, border.push_back(seed);
  const auto enter = [&](std::size_t n) {
    if (inside[n] || barred[n] || gradient.values[n] > wall.edge / 2 ||
        image.values[n] < wall.darkest - wall.contrast / 2 || image.values[n] > wall.brightest + wall.contrast / 2)
      return;
    inside[n] = 1, border.push_back(n);
  };
  while (!border.empty()) {
    const std::size_t n = border.back();
    border.pop_back();
    const std::array<int, 3> voxel = image.voxel(n);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (voxel[axis] > 0) enter(n - stride[axis]);
      if (voxel[axis] + 1 < image.count[axis]) enter(n + stride[axis]);
    }
  }
  return inside;
}

}  // namespace tether
