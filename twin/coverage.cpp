#include <Eigen/Geometry>
#include <cmath>

#include "twin/voxels.hpp"

namespace tether {
namespace {

/// Whether p lies left of the way from a to b in the plane z = 0, by the area of (a, b, p). That is taken from the
/// lower to the higher node, so that both triangles of an edge get the same number, and each line falls into exactly
/// one of them.
bool is_left(const Points& x, int a, int b, double px, double py) {
  const int low = std::min(a, b), high = std::max(a, b);
  const double area = (x(0, high) - x(0, low)) * (py - x(1, low)) - (x(1, high) - x(1, low)) * (px - x(0, low));
  return (area > 0) == (low == a);
}

/// Where a line along z crosses a triangle adds to, or takes from, all that lies above.
class Coverage {
 public:
  Coverage(const TriangleSurface& surface, VoxelImage image, int lines)
      : surface_(surface), image_(std::move(image)), lines_(lines), sums_(image_.values.size(), 0.0) {}

  VoxelImage operator()() {
    for (const Triangle& triangle : surface_.triangles) add(triangle);
    std::transform(sums_.begin(), sums_.end(), image_.values.begin(),
                   [](double sum) { return static_cast<float>(std::clamp(sum, 0.0, 1.0)); });
    return std::move(image_);
  }

 private:
  double probe(int axis, int number) const {
    return image_.origin[axis] + image_.spacing[axis] * ((number + 0.5) / lines_ - 0.5);
  }
  /// The first probe at or beyond a coordinate.
  int first_probe(int axis, double coordinate) const {
    const double place = ((coordinate - image_.origin[axis]) / image_.spacing[axis] + 0.5) * lines_ - 0.5;
    return static_cast<int>(std::ceil(place));
  }

  void add(const Triangle& t) {
    const auto corners = surface_.points(Eigen::all, t);
    const Vec3 low = corners.rowwise().minCoeff(), high = corners.rowwise().maxCoeff();
    const Vec3 normal = Vec3(corners.col(1) - corners.col(0)).cross(Vec3(corners.col(2) - corners.col(0)));
    if (normal.z() == 0) return;
    for (int j = first_probe(1, low.y()); probe(1, j) <= high.y(); ++j)
      for (int i = first_probe(0, low.x()); probe(0, i) <= high.x(); ++i) {
        const double x = probe(0, i), y = probe(1, j);
        const bool left = normal.z() > 0;
        bool within = true;
        for (int k = 0; k < 3; ++k) within = within && is_left(surface_.points, t[k], t[(k + 1) % 3], x, y) == left;
        if (!within) continue;
        const Vec3 a = corners.col(0);
        cross(i, j, a.z() - (normal.x() * (x - a.x()) + normal.y() * (y - a.y())) / normal.z(), left ? -1.0 : 1.0);
      }
  }

  void cross(int i, int j, double z, double sign) {
    const double share = sign / (lines_ * lines_);
    const double place = (z - image_.origin.z()) / image_.spacing.z() + 0.5;
    const int voxel = static_cast<int>(std::floor(place));
    const auto [nx, ny, nz] = image_.count;
    std::size_t at = index(i / lines_, j / lines_, voxel);
    sums_[at] += share * (voxel + 1 - place);
    for (int k = voxel + 1; k < nz; ++k)
      sums_[at += static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny)] += share;
  }
  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(image_.count[0]) *
               (static_cast<std::size_t>(j) + static_cast<std::size_t>(image_.count[1]) * static_cast<std::size_t>(k));
  }

  const TriangleSurface& surface_;
  VoxelImage image_;
  int lines_;
  std::vector<double> sums_;
};

}  // namespace

VoxelImage coverage(const TriangleSurface& closed, const Vec3& spacing, const Vec3& shift, double rim, int lines) {
  VoxelImage image;
  image.spacing = spacing;
  std::size_t total = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = closed.points.row(axis).minCoeff() - rim, high = closed.points.row(axis).maxCoeff() + rim;
    const double first = std::floor((low - shift[axis]) / spacing[axis]) - 1;
    image.origin[axis] = shift[axis] + first * spacing[axis];
    image.count[static_cast<std::size_t>(axis)] =
        static_cast<int>(std::ceil((high - image.origin[axis]) / spacing[axis])) + 2;
    total *= static_cast<std::size_t>(image.count[static_cast<std::size_t>(axis)]);
  }
  image.values.resize(total);
  return Coverage(closed, std::move(image), lines)();
}

}  // namespace tether
