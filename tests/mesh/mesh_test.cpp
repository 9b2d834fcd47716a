#include "common/mesh/mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/mesh/surface.hpp"
#include "tests/mesh/box.hpp"
#include "tests/mesh/mesh_assertions.hpp"
#include "vessel/quality.hpp"

namespace tether {
namespace {

const Points unit_prism = (Points(3, 6) << 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 1, 1).finished();

TEST(Split, every_numbering_of_a_prism_gives_three_positive_tetrahedra_and_diagonals_at_the_smallest_node) {
  Prism order{0, 1, 2, 3, 4, 5};
  do {
    Points points(3, 6);
    for (std::size_t i = 0; i < 6; ++i) points.col(order[i]) = unit_prism.col(static_cast<int>(i));
    const std::vector<Tetrahedron> parts = split_into_tetrahedra({order});
    ASSERT_EQ(parts.size(), 3u);
    for (const Tetrahedron& part : parts) ASSERT_NEAR(signed_volume(points, part), 1.0 / 6, 1e-15);
    const std::vector<Triangle> boundary = boundary_triangles(parts);
    ASSERT_EQ(boundary.size(), 8u);
    for (const std::array<std::size_t, 4>& side : {std::array<std::size_t, 4>{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}})
      for (const Triangle& half : split_quadrilateral(order[side[0]], order[side[1]], order[side[2]], order[side[3]]))
        ASSERT_EQ(std::count_if(boundary.begin(), boundary.end(),
                                [&](const Triangle& t) { return canonical(t) == canonical(half); }),
                  1);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(Box, is_conforming_with_six_flat_sides) {
  const BoxMesh box = box_mesh({1, 2, 3}, {2, 3, 4});
  EXPECT_EQ(box.tetrahedra.size(), 6u * 24u);
  EXPECT_NEAR(total_volume(box.points, box.tetrahedra), 6, 1e-13);
  std::vector<Triangle> all;
  append(all, {box.sides.begin(), box.sides.end()});
  expect_bounded_by(box.points, box.tetrahedra, all);
  EXPECT_NEAR((total_area_vector(box.points, box.sides[1].triangles) - Vec3(6, 0, 0)).norm(), 0, 1e-13);
  EXPECT_NEAR((total_area_vector(box.points, box.sides[4].triangles) - Vec3(0, 0, -2)).norm(), 0, 1e-13);
}

TEST(Topology, finds_rims_and_parts) {
  const std::vector<Triangle> two{{0, 1, 2}, {0, 2, 3}, {5, 6, 7}};
  EXPECT_EQ(connected_parts(8, two).count, 2);
  EXPECT_EQ(connected_parts(8, two).part, (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(rims(two), (std::vector<std::vector<int>>{{0, 1, 2, 3}, {5, 6, 7}}));
  EXPECT_EQ(nodes_of(two), (std::vector<int>{0, 1, 2, 3, 5, 6, 7}));
}

TEST(Quality, is_one_for_a_regular_tetrahedron_and_known_for_a_corner) {
  const Points regular = (Points(3, 4) << 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1, 1).finished();
  Tetrahedron t{0, 1, 2, 3};
  if (signed_volume(regular, t) < 0) std::swap(t[0], t[1]);
  EXPECT_NEAR(radius_ratio(regular, t), 1, 1e-14);
  EXPECT_NEAR(min_dihedral_angle(regular, t), 70.528779, 1e-6);
  const Points corner = (Points(3, 4) << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1).finished();
  EXPECT_NEAR(radius_ratio(corner, {0, 1, 2, 3}), 3 * (1 / (3 + std::sqrt(3.0))) / (std::sqrt(3.0) / 2), 1e-14);
  EXPECT_EQ(radius_ratio(corner, {0, 2, 1, 3}), 0);
}

TEST(Closest_point_of_a_triangle, lies_on_a_corner_an_edge_or_inside) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_EQ(closest_in_triangle({-1, -1, 2}, a, b, c), Vec3(1, 0, 0));
  EXPECT_EQ(closest_in_triangle({3, -1, 2}, a, b, c), Vec3(0, 1, 0));
  EXPECT_EQ(closest_in_triangle({-1, 3, 2}, a, b, c), Vec3(0, 0, 1));
  EXPECT_EQ(closest_in_triangle({0.25, -1, 2}, a, b, c), Vec3(0.75, 0.25, 0));
  EXPECT_EQ(closest_in_triangle({-1, 0.25, 2}, a, b, c), Vec3(0.75, 0, 0.25));
  EXPECT_LT((closest_in_triangle({1, 1, 2}, a, b, c) - Vec3(0, 0.5, 0.5)).norm(), 1e-15);
  EXPECT_LT((closest_in_triangle({0.25, 0.5, 2}, a, b, c) - Vec3(0.25, 0.25, 0.5)).norm(), 1e-15);
}

}  // namespace
}  // namespace tether
