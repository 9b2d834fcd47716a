#include "vessel/vessel_files.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/base/error.hpp"
#include "common/io/vtu_writer.hpp"
#include "tests/io/peer_tube.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/mesh/mesh_assertions.hpp"
#include "vessel/check.hpp"
#include "vessel/recombine.hpp"
#include "vessel/sweep.hpp"

namespace tether {
namespace vessel_files_test {

constexpr double pi = std::numbers::pi;

TEST(PeerTube, WallIsRecombinedToPrisms) {
  const VesselMesh tube = read_vessel(peer_tube_files());
  EXPECT_EQ(tube.fluid.points.cols(), 1911);
  EXPECT_EQ(tube.fluid.tetrahedra.size(), 9360u);
  EXPECT_EQ(tube.fluid.interface.size(), 960u);
  EXPECT_EQ(tube.wall.points.cols(), 1512);
  EXPECT_EQ(tube.wall.prisms.size(), 5760u / 3);
  EXPECT_TRUE(tube.wall.tetrahedra.empty());
  expect_valid(tube.fluid);
  expect_valid(tube.wall);
  expect_matching(tube, 0);
  check(tube, UnitSystem::cgs());
  const double polygon = 12 * std::sin(pi / 12);
  EXPECT_NEAR(total_volume(tube.fluid.points, tube.fluid.tetrahedra), polygon * 40, 1e-5);
  EXPECT_NEAR(total_volume(tube.wall.points, split_into_tetrahedra(tube.wall.prisms)), polygon * 8.4, 1e-5);
}

TEST(PeerTube, WallCanStayTetrahedra) {
  VesselFiles files = peer_tube_files();
  files.prisms = false;
  const VesselMesh tube = read_vessel(files);
  EXPECT_EQ(tube.wall.tetrahedra.size(), 5760u);
  EXPECT_TRUE(tube.wall.prisms.empty());
  expect_valid(tube.wall);
  expect_matching(tube, 0);
}

TEST(PeerTube, FacesAreNamedAndOriented) {
  const VesselMesh tube = read_vessel(peer_tube_files());
  EXPECT_GT(total_area_vector(tube.fluid.points, tube.fluid.outlets[0].triangles)[2], 12);
  EXPECT_LT(total_area_vector(tube.fluid.points, tube.fluid.inlets[0].triangles)[2], -12);
  ASSERT_EQ(tube.wall.outside.size(), 4u);
  EXPECT_EQ(tube.wall.outside[0].name, "spine");
  EXPECT_EQ(tube.wall.outside[0].triangles.size(), 160u);
  EXPECT_NEAR(total_area(tube.wall.points, tube.wall.outside[0].triangles), 4 * 2 * 2.2 * std::sin(pi / 24) * 10, 1e-5);
  EXPECT_LT(centroid(tube.wall.points, tube.wall.outside[0].triangles)[0], -2);
  EXPECT_EQ(tube.wall.rings[1].name, "outlet_ring");
  EXPECT_GT(total_area_vector(tube.wall.points, tube.wall.rings[1].triangles)[2], 2.5);
}

TEST(PeerTube, WallIsGrownWhereNoneIsGiven) {
  VesselFiles files = peer_tube_files();
  files.wall.clear();
  files.extrusion = {0.2, 3};
  files.regions = {{"spine", 150, 210}, {"rest"}};
  const VesselMesh tube = read_vessel(files);
  EXPECT_EQ(tube.wall.prisms.size(), 3u * 960u);
  expect_valid(tube.wall);
  expect_matching(tube, 0);
  check(tube, UnitSystem::cgs());
  EXPECT_EQ(tube.wall.outside[0].triangles.size(), 160u);
  EXPECT_LT(centroid(tube.wall.points, tube.wall.outside[0].triangles)[0], -2);
}

TEST(PeerTube, ScaleMultipliesAllFiles) {
  VesselFiles files = peer_tube_files();
  files.scale = 0.01;
  const VesselMesh tube = read_vessel(files);
  check(tube, UnitSystem::si());
  EXPECT_NEAR(mean_lumen_diameter(tube.fluid), 0.04, 4e-4);
  files.scale = 1;
  const std::string message = message_of([&] { check(read_vessel(files), UnitSystem::si()); });
  EXPECT_NE(message.find("must be 0.3 to 120 mm in units: SI"), std::string::npos) << message;
  EXPECT_NE(message.find("Multiplied by 0.01 it would be"), std::string::npos) << message;
}

/// A vessel written with triangles and labels in the same file, wall as prisms or as tetrahedra: read back by label.
class LabelledFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    const VesselMesh tube = circular_tube(2, 10, 0.2, 12, 6);
    write("fluid.vtu", tube.fluid.points, cells_of(tube.fluid),
          {tube.fluid.interface, tube.fluid.inlets[0].triangles, tube.fluid.outlets[0].triangles});
    const std::vector<std::vector<Triangle>> faces{tube.wall.interface, tube.wall.outside[0].triangles,
                                                   tube.wall.rings[0].triangles, tube.wall.rings[1].triangles};
    write("wall.vtu", tube.wall.points, cells_of(tube.wall), faces);
    const std::vector<Tetrahedron> split = split_into_tetrahedra(tube.wall.prisms);
    write("wall_tetrahedra.vtu", tube.wall.points, {.tetrahedra = split}, faces);
    files_.fluid = folder_ / "fluid.vtu";
    files_.wall = folder_ / "wall.vtu";
    files_.interface = files_.wall_interface = {{}, "1"};
    files_.inlets = {{"inlet", {{}, "2"}}};
    files_.outlets = {{"outlet", {{}, "3"}}};
    files_.outside = {{"wall", {{}, "2"}}};
    files_.rings = {{"inlet_ring", {{}, "3"}}, {"outlet_ring", {{}, "4"}}};
    files_.label_array = "face";
  }
  void write(const std::string& name, const Points& points, Cells cells,
             const std::vector<std::vector<Triangle>>& faces) {
    std::vector<double> labels(cells.count(), 0);
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      triangles.insert(triangles.end(), faces[i].begin(), faces[i].end());
      labels.resize(labels.size() + faces[i].size(), static_cast<double>(i + 1));
    }
    cells.triangles = triangles;
    write_vtu(folder_ / name, points, cells, {}, {{"face", 1, labels}});
  }
  TemporaryFolder folder_;
  VesselFiles files_;
};

TEST_F(LabelledFiles, AreReadWithPrismsOrTetrahedra) {
  for (const char* wall : {"wall.vtu", "wall_tetrahedra.vtu"})
    for (const bool prisms : {true, false}) {
      files_.wall = folder_ / wall;
      files_.prisms = prisms;
      const VesselMesh tube = read_vessel(files_);
      EXPECT_EQ(tube.wall.prisms.size(), prisms ? 12u * 6 * 2 * 2 : 0u);
      EXPECT_EQ(tube.wall.tetrahedra.size(), prisms ? 0u : 12u * 6 * 2 * 2 * 3);
      expect_valid(tube.fluid);
      expect_valid(tube.wall);
      expect_matching(tube, 0);
      check(tube, UnitSystem::cgs());
    }
}

TEST_F(LabelledFiles, MistakesAreNamed) {
  const auto message = [&](auto change) {
    VesselFiles files = files_;
    change(files);
    return message_of([&] { read_vessel(files); });
  };
  const auto expect = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect(message([](VesselFiles& f) { f.outlets[0].second.label = "9"; }),
         "no triangle carries the label 9 in \"face\"; labels there: 1, 2, 3");
  expect(message([](VesselFiles& f) { f.outlets[0].second.label = "lumen"; }),
         "\"lumen\" is neither an integer nor the name");
  expect(message([](VesselFiles& f) { f.label_array = "ModelFaceID"; }),
         "has no array \"ModelFaceID\" on triangles; arrays in the file: face");
  expect(message([](VesselFiles& f) {
           f.fluid = "data/peer_tube/fluid/mesh.vtu";
           f.interface = peer_tube_files().interface;
           f.inlets.clear();
           f.outlets.clear();
         }),
         "has no partner on the wall");
  expect(message([](VesselFiles& f) { f.interface = peer_tube_files().interface; }), "is no node of");
  expect(message([](VesselFiles& f) { f.fluid = f.wall; }), "the lumen must be of tetrahedra");
  expect(message([](VesselFiles& f) { f.fluid = peer_tube_files().interface.file; }), "must be one kind");
}

TEST(Recombine, RefusesAWallWithoutLayers) {
  const VesselMesh tube = circular_tube(2, 10, 0.2, 12, 6);
  std::vector<Triangle> inlet = tube.fluid.inlets[0].triangles;
  for (Triangle& t : inlet) std::swap(t[1], t[2]);
  const std::string message = message_of(
      [&] { recombine_prisms(tube.fluid.points, tube.fluid.tetrahedra, tube.fluid.interface, "fluid.vtu"); });
  EXPECT_NE(message.find("fluid.vtu: the wall is not made of layers"), std::string::npos) << message;
  EXPECT_NE(message.find("solid.element: p1"), std::string::npos) << message;
  // Seen from its inlet, the lumen IS layered: as many layers as intervals.
  EXPECT_EQ(recombine_prisms(tube.fluid.points, tube.fluid.tetrahedra, inlet, "x").size(), 6 * inlet.size());
  std::vector<Tetrahedron> torn = tube.fluid.tetrahedra;
  torn.pop_back();
  EXPECT_THROW(recombine_prisms(tube.fluid.points, torn, inlet, "x"), InputError);
}

}  // namespace vessel_files_test
}  // namespace tether
