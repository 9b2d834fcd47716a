#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "common/mesh/mesh.hpp"
#include "common/mesh/surface.hpp"
#include "common/mesh/topology.hpp"

/// What every valid mesh of this project satisfies.
namespace tether {

inline double total_volume(const Points& points, const std::vector<Tetrahedron>& tetrahedra) {
  double sum = 0;
  for (const Tetrahedron& t : tetrahedra) sum += signed_volume(points, t);
  return sum;
}

/// The same triangle with its smallest node first: equal for equal orientation.
inline Triangle canonical(Triangle t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

/// Every face is shared by two elements or lies on the boundary; the boundary is the disjoint union of the patches,
/// with their orientation; it is closed and its nodes are all used.
inline void expect_bounded_by(const Points& points, const std::vector<Tetrahedron>& tetrahedra,
                              const std::vector<Triangle>& patches) {
  for (const Tetrahedron& t : tetrahedra) ASSERT_GT(signed_volume(points, t), 0);
  const std::vector<OwnedFace> faces = sorted_faces(tetrahedra);
  for (std::size_t i = 2; i < faces.size(); ++i)
    ASSERT_FALSE(faces[i - 2].key == faces[i].key) << "three elements on a face";
  std::set<Triangle> boundary, covered;
  for (const Triangle& t : boundary_triangles(tetrahedra)) boundary.insert(canonical(t));
  for (const Triangle& t : patches) EXPECT_TRUE(covered.insert(canonical(t)).second) << "a triangle in two patches";
  EXPECT_EQ(boundary, covered);
  EXPECT_LT(total_area_vector(points, patches).norm(), 1e-12 * total_area(points, patches));
  std::set<int> used;
  for (const Tetrahedron& t : tetrahedra) used.insert(t.begin(), t.end());
  EXPECT_EQ(static_cast<Eigen::Index>(used.size()), points.cols());
}

inline void append(std::vector<Triangle>& all, const std::vector<Patch>& patches) {
  for (const Patch& patch : patches) all.insert(all.end(), patch.triangles.begin(), patch.triangles.end());
}

inline void expect_valid(const FluidMesh& fluid) {
  std::vector<Triangle> all = fluid.interface;
  append(all, fluid.inlets);
  append(all, fluid.outlets);
  expect_bounded_by(fluid.points, fluid.tetrahedra, all);
}

inline void expect_valid(const WallMesh& wall) {
  std::vector<Triangle> all;
  for (const Triangle& t : wall.interface) all.push_back({t[0], t[2], t[1]});  // stored INTO the wall
  append(all, wall.outside);
  append(all, wall.rings);
  expect_bounded_by(wall.points, wall.prisms.empty() ? wall.tetrahedra : split_into_tetrahedra(wall.prisms), all);
}

/// Interface nodes of the wall come first, in ascending order of the fluid's, at the same places, with the same
/// triangles.
inline void expect_matching(const VesselMesh& vessel, double tolerance) {
  const std::vector<int> nodes = nodes_of(vessel.fluid.interface);
  ASSERT_EQ(static_cast<int>(nodes.size()), vessel.wall.interface_nodes);
  for (int i = 0; i < vessel.wall.interface_nodes; ++i)
    EXPECT_LE((vessel.fluid.points.col(nodes[static_cast<std::size_t>(i)]) - vessel.wall.points.col(i)).norm(),
              tolerance);
  std::set<Triangle> of_fluid, of_wall;
  for (const Triangle& t : vessel.fluid.interface) of_fluid.insert(canonical(t));
  for (const Triangle& t : vessel.wall.interface)
    of_wall.insert(canonical({nodes[static_cast<std::size_t>(t[0])], nodes[static_cast<std::size_t>(t[1])],
                              nodes[static_cast<std::size_t>(t[2])]}));
  EXPECT_EQ(of_fluid, of_wall);
}

}  // namespace tether
