#include "vessel/model/vessel_model.hpp"

#include <gtest/gtest.h>

#include "common/base/error.hpp"
#include "common/config/case_file.hpp"
#include "common/io/record_file.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/vessel/anatomies/closed_bifurcation.hpp"
#include "vessel/check.hpp"
#include "vessel/volume/tetrahedra.hpp"

namespace tether {
namespace model_test {

/// bone: a file with a line toward which the sector of the region `spine` looks, in mm.
VolumeCase study_of_regions(const std::filesystem::path& bone) {
  VolumeCase study;
  study.wall.thickness.thickness = 0.2;
  ThicknessCase thin;
  thin.thickness = 0.1;
  study.wall.branches.emplace_back("branch", thin);
  GeometricRegionCase branch, sector;
  branch.branches = {"branch"};
  sector.branches = {"trunk"};
  sector.angle = {-30, 30};
  sector.toward = ObjectCase{{}, bone, ""};
  study.regions = {{"branch", branch}, {"spine", sector}, {"rest", {}}};
  return study;
}

TEST(VesselModel, IsBuiltFromASurfaceAndReadBackByACase) {
  const TemporaryFolder folder;
  const VolumeCase study =
      study_of_regions(folder.file("bone.csv", "x [mm], y [mm], z [mm]\n-40, 0, -100\n-40, 0, 200\n"));
  const LabelledSurface surface = closed_bifurcation(0.3);
  const CentrelineTree tree = bifurcation(0.4).tree;
  const VesselModel model = build_model(surface, tree, study, UnitSystem::cgs());
  EXPECT_EQ(model.mesh.fluid.points.leftCols(surface.points.cols()), surface.points);
  EXPECT_EQ(model.mesh.fluid.inlets.at(0).name, "inlet");
  EXPECT_EQ(model.mesh.fluid.outlets.size(), 2u);
  const ModelQuality& q = model.quality;
  EXPECT_GT(q.blood.least_radius_ratio, 0.15);
  EXPECT_GT(q.blood.least_dihedral, 8);
  EXPECT_GT(q.wall.least_jacobian, 0.1);
  EXPECT_EQ(q.wall.layers, 2);
  EXPECT_GT(q.thickness.least_share, 0.8);
  EXPECT_NEAR(q.thickness.most_asked, 0.2, 1e-9);
  EXPECT_NEAR(q.thickness.least_asked, 0.1, 1e-9);
  ASSERT_EQ(q.regions.size(), 3u);
  EXPECT_EQ(q.regions[1].name, "spine");

  write_model(folder.path() / "model", "arch_model", model, tree, study, UnitSystem::cgs());
  std::filesystem::remove(folder / "bone.csv");  // what the model needs is in its folder
  std::ifstream text(folder / "model/case.yaml");
  const std::string content((std::istreambuf_iterator<char>(text)), {});
  EXPECT_EQ(content.find(folder.path().string()), std::string::npos);  // it can be moved
  CaseFile file(folder / "model/case.yaml");
  EXPECT_EQ(file.common().name, "arch_model");
  MeshCase mesh;
  file.read("mesh", mesh);
  const VesselMesh again = load_mesh(mesh, file, WallElement::prism);
  EXPECT_EQ(again.fluid.tetrahedra.size(), model.mesh.fluid.tetrahedra.size());
  ASSERT_EQ(again.wall.outside.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(area_of(again.wall.points, again.wall.outside[i]), q.regions[i].area, 1e-6) << i;
  EXPECT_EQ(again.wall.rings.size(), 3u);
  EXPECT_EQ(read_record<ModelQuality>(folder.path() / "model/quality.json").wall.elements, q.wall.elements);

  folder.file("model/mine.txt", "mine");
  remove_model(folder / "model");
  const std::filesystem::directory_iterator left(folder / "model");
  EXPECT_EQ(left->path().filename(), "mine.txt");
  EXPECT_EQ(std::distance(left, {}), 1);
  folder.file("model/wall.vtu", "mine");
  remove_model(folder / "model");
  EXPECT_TRUE(std::filesystem::exists(folder / "model/wall.vtu")) << "without quality.json it is somebody else's";
  folder.file("model/quality.json", "");
  std::filesystem::remove(folder / "model/mine.txt");
  remove_model(folder / "model");
  EXPECT_FALSE(std::filesystem::exists(folder / "model"));
}

TEST(VesselModel, PartsOfADividedRegionNeedNamesOfTheirOwn) {
  const Anatomy anatomy(bifurcation(0.4).tree);
  GeometricRegionCase single, divided;
  single.branches = {"branch"};
  divided.divide = 2;
  const auto where = [](const std::string& name) { return "regions." + name; };
  const auto rules = [&](const Named<GeometricRegionCase>& regions) {
    return rules_of(regions, &anatomy, UnitSystem::cgs(), where);
  };
  EXPECT_EQ(rules({{"y_1", single}, {"x", divided}}).size(), 3U);
  try {
    rules({{"x_1", single}, {"x", divided}});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "regions.x: two regions would be called x_1: the parts of a divided one have its name and a number");
  }
}

TEST(VesselModel, WhatCannotBeFilledIsToldWithItsPlace) {
  const LabelledSurface good = closed_bifurcation(0.4);
  const auto fault = [](const LabelledSurface& surface) -> std::string {
    try {
      fill_with_tetrahedra(surface, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  LabelledSurface open = good;
  open.triangles.pop_back(), open.label.pop_back();
  EXPECT_NE(fault(open).find("the surface is open near ("), std::string::npos) << fault(open);
  LabelledSurface turned = good;
  std::swap(turned.triangles[0][1], turned.triangles[0][2]);
  EXPECT_NE(fault(turned).find("or some that look inward"), std::string::npos) << fault(turned);
  LabelledSurface crossing = good;
  crossing.points.col(crossing.triangles[0][0]).head<2>() *= -2;  // through the opposite side
  EXPECT_NE(fault(crossing).find("crosses itself near ("), std::string::npos) << fault(crossing);
}

}  // namespace model_test
}  // namespace tether
