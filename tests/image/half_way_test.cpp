#include "vessel/image/half_way.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tether {
namespace {

constexpr double side = 0.1;                          // of a voxel [cm]
constexpr double blur = 0.12;                         // deviation [cm]
const Vec3 across = Vec3(1, 0.3, -0.2).normalized();  // a wall's normal, along no axis
constexpr double lumen = 350, tissue = 50, contrast = 300;
const double edge = contrast / (blur * std::sqrt(2 * M_PI));  // [per cm]

ImageVolume volume(int count) {
  const std::array<int, 3> voxels{count, count, count};
  return {"made",           voxels,
          Vec3::Zero(),     Vec3::Constant(side),
          Mat3::Identity(), std::vector<float>(static_cast<std::size_t>(count) * count * count)};
}

/// Values by depth [cm] in the lumen below a plane through the middle.
ImageVolume by_depth(auto value) {
  ImageVolume image = volume(24);
  const Vec3 middle = Vec3::Constant(11.5 * side);
  for (std::size_t n = 0; n < image.values.size(); ++n)
    image.values[n] = static_cast<float>(value(-across.dot(image.place(n) - middle)));
  return image;
}

double blurred(double depth, double inside, double outside) {
  return outside + (inside - outside) * (1 + std::erf(depth / (blur * std::sqrt(2)))) / 2;
}

/// A front that lies this much deeper than the wall, in voxels, as far as a level set knows it.
ImageVolume front(double deeper) {
  return by_depth([&](double depth) { return std::clamp(depth / side - deeper, -4.0, 4.0); });
}

/// Mean depth of the zero surface between neighbours along x, in voxels, away from the image's border.
double depth_of(const ImageVolume& field) {
  const ImageVolume depth = front(0);
  double sum = 0;
  int count = 0;
  for (int k = 6; k < 18; ++k)
    for (int j = 6; j < 18; ++j)
      for (int i = 0; i + 1 < 24; ++i) {
        const std::size_t here = field.at(i, j, k), next = field.at(i + 1, j, k);
        const double a = field.values[here], b = field.values[next];
        if ((a > 0) == (b > 0)) continue;
        const double t = a / (a - b);
        sum += (1 - t) * depth.values[here] + t * depth.values[next], ++count;
      }
  return sum / count;
}

double depth_after(double deeper, double inside, double outside) {
  ImageVolume field = front(deeper);
  const ImageVolume image = by_depth([&](double depth) { return blurred(depth, inside, outside); });
  move_half_way(field, image, std::vector<char>(field.values.size(), 0), contrast, edge);
  return depth_of(field);
}

TEST(HalfWay, IsWhereTheWallIsToATenthOfAVoxel) {
  for (const double deeper : {-0.6, -0.3, 0.3, 0.6}) {
    EXPECT_NEAR(depth_after(deeper, lumen, tissue), 0, 0.1) << deeper;
    EXPECT_NEAR(depth_after(deeper, tissue, lumen), 0, 0.1) << "of dark blood, " << deeper;
  }
  EXPECT_NEAR(depth_after(0, lumen, tissue), 0, 1e-3) << "one that is there stays";
}

TEST(HalfWay, IsNotFartherThanAVoxel) {
  EXPECT_NEAR(depth_after(1.6, lumen, tissue), 0.6, 0.1);
  EXPECT_NEAR(depth_after(-1.6, lumen, tissue), -0.6, 0.1);
}

/// Of a neighbour that is named, or where nothing but noise tells the sides apart, the front knows more.
TEST(HalfWay, IsNotSoughtWhereTheSidesAreAlikeOrTheFrontIsKept) {
  EXPECT_NEAR(depth_after(0.6, lumen, lumen - contrast / 2.1), 0.6, 1e-6);
  const ImageVolume before = front(0.6), image = by_depth([](double depth) { return blurred(depth, lumen, tissue); });
  ImageVolume field = before;
  move_half_way(field, image, std::vector<char>(field.values.size(), 1), contrast, edge);
  EXPECT_EQ(field.values, before.values);
}

}  // namespace
}  // namespace tether
