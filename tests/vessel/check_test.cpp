#include "vessel/check.hpp"

#include <gtest/gtest.h>

#include "common/base/error.hpp"
#include "common/mesh/locator.hpp"
#include "tests/mesh/box.hpp"
#include "vessel/sweep.hpp"

namespace tether {
namespace check_test {

/// What `check` says of the tube after a change.
template <class Change>
std::string message_after(const Change& change) {
  VesselMesh tube = circular_tube(2, 10, 0.2, 12, 5);
  change(tube);
  try {
    check(tube, UnitSystem::cgs());
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}
void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(Check, AGoodTubePasses) {
  EXPECT_EQ(message_after([](VesselMesh&) {}), "accepted");
  EXPECT_EQ(message_after([](VesselMesh& m) { use_tetrahedra(m.wall); }), "accepted");
}

TEST(Check, InvertedAndFlatElementsAreCountedAndTheWorstIsNamed) {
  expect_part(message_after([](VesselMesh& m) {
                std::swap(m.fluid.tetrahedra[7][0], m.fluid.tetrahedra[7][1]);
                std::swap(m.fluid.tetrahedra[9][0], m.fluid.tetrahedra[9][1]);
              }),
              "fluid mesh: 2 of ");
  const std::string moved = message_after([](VesselMesh& m) { m.fluid.points.col(0) = m.fluid.points.col(1); });
  expect_part(moved, "tetrahedra are inverted or flat: the worst is number ");
  expect_part(moved, "must be positive");
  expect_part(message_after([](VesselMesh& m) { m.wall.points.col(100) *= 0.5; }), "prisms are inverted or flat");
}

TEST(Check, AnOpeningWithoutAnInnerNodeIsNamed) {
  const BoxMesh box = box_mesh({1, 1, 2}, {1, 1, 2});
  FluidMesh fluid{
      box.points, box.tetrahedra, {}, {{"mouth", box.sides[4].triangles}}, {{"end", box.sides[5].triangles}}};
  for (std::size_t side = 0; side < 4; ++side)
    fluid.interface.insert(fluid.interface.end(), box.sides[side].triangles.begin(), box.sides[side].triangles.end());
  try {
    check(fluid);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    expect_part(error.what(), "face mouth, near (0.5, 0.5, 0), has no node inside its rim");
  }
}

TEST(Check, NegativeThicknessIsSeen) {
  expect_part(message_after([](VesselMesh& m) {
                const int n = m.wall.interface_nodes;
                const Points outer = m.wall.points.rightCols(n);
                m.wall.points.rightCols(n) = 2 * m.wall.points.leftCols(n) - outer;  // the outer layer turned inside
              }),
              "must be positive, the wall's thickness too");
}

TEST(Check, UnlabelledTrianglesAreCounted) {
  expect_part(message_after([](VesselMesh& m) { m.fluid.outlets[0].triangles.resize(1); }),
              "boundary triangles carry no label, the first near");
  expect_part(message_after([](VesselMesh& m) { m.wall.rings.pop_back(); }),
              "wall mesh: 48 of its 336 boundary triangles carry no label");
}

TEST(Check, LabelsMustHaveTrianglesOfTheirOwnOnTheBoundary) {
  expect_part(message_after([](VesselMesh& m) {
                m.wall.outside.push_back({"spine", {}});
              }),
              "wall mesh: face spine: has no triangle");
  expect_part(message_after([](VesselMesh& m) {
                m.fluid.outlets.push_back({"twice", {m.fluid.inlets[0].triangles[0]}});
              }),
              "is in two faces, inlet and twice");
  expect_part(message_after([](VesselMesh& m) {
                const Tetrahedron& t = m.fluid.tetrahedra[200];
                m.fluid.outlets.push_back(
                    {"inside", {{t[0], t[1], t[2]}, {t[0], t[1], t[3]}, {t[1], t[2], t[3]}, {t[0], t[2], t[3]}}});
              }),
              "is not on the mesh's boundary");
  expect_part(message_after([](VesselMesh& m) {
                m.fluid.inlets.clear();
                m.fluid.outlets.clear();
              }),
              "has neither inlet nor outlet");
}

TEST(Check, SeparatePartsAreCounted) {
  expect_part(message_after([](VesselMesh& m) {
                const auto n = static_cast<int>(m.fluid.points.cols());
                m.fluid.points.conservativeResize(3, n + 4);
                m.fluid.points.rightCols(4) << 20, 21, 20, 20, 0, 0, 1, 0, 0, 0, 0, 1;
                m.fluid.tetrahedra.push_back({n, n + 1, n + 2, n + 3});
              }),
              "fluid mesh: falls into 2 separate parts, one of them near (20.25, 0.25, 0.25)");
  expect_part(message_after([](VesselMesh& m) { m.fluid.tetrahedra.clear(); }), "fluid mesh: has no elements");
}

TEST(Check, InterfaceMustMatchNodeForNode) {
  expect_part(message_after([](VesselMesh& m) { m.wall.points.col(13) *= 1.001; }), "apart: must coincide");
  expect_part(message_after([](VesselMesh& m) { --m.wall.interface_nodes; }),
              "72 nodes on the fluid's side, 71 on the wall's");
}

TEST(Check, SizesOutOfReasonNameTheLikelyFactor) {
  const auto scaled = [](double factor) {
    return message_after([factor](VesselMesh& m) {
      m.fluid.points *= factor;
      m.wall.points *= factor;
    });
  };
  EXPECT_EQ(scaled(0.25), "accepted");
  expect_part(scaled(10), "must be 0.3 to 120 mm in units: cgs");
  expect_part(scaled(10), "Multiplied by 0.1 it would be");
  expect_part(scaled(0.01 * 0.5), "Multiplied by 100 it would be");
  expect_part(message_after([](VesselMesh& m) { m.wall = circular_tube(2, 10, 2.5, 12, 5).wall; }),
              "must be 0.001 to 0.5 of it");
}

TEST(Report, KnowsTheTube) {
  const MeshReport r = report(circular_tube(2, 10, 0.2, 48, 20));
  EXPECT_EQ(r.wall_elements, 48 * 20 * 4);
  EXPECT_NEAR(r.lumen_diameter, 4, 0.02);
  EXPECT_NEAR(r.wall_thickness, 0.2, 0.001);
}

TEST(Locator, FindsTheNearestPoint) {
  std::srand(1);
  const Points points = Points::Random(3, 500);
  const PointLocator locator(points);
  for (int i = 0; i < 200; ++i) {
    const Vec3 x = 1.5 * Vec3::Random();
    Eigen::Index expected = 0;
    const double distance = (points.colwise() - x).colwise().norm().minCoeff(&expected);
    EXPECT_EQ(locator.nearest(x).node, expected);
    EXPECT_DOUBLE_EQ(locator.nearest(x).distance, distance);
  }
  EXPECT_EQ(PointLocator(Points(3, 0)).nearest({0, 0, 0}).node, -1);
}

}  // namespace check_test
}  // namespace tether
