#include <gtest/gtest.h>

#include "common/base/child_process.hpp"
#include "common/base/error.hpp"
#include "common/io/record_file.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/study/bent_tube.hpp"
#include "vessel/study/study_case.hpp"
#include "vessel/study/surface_summary.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// The test's folder with a study of a surface; `more` is added to the file.
fs::path study_with(const std::string& more, const RawSurface& surface) {
  const fs::path& folder = test_folder();
  testing::write_stl(folder / "tube.stl", surface);
  std::ofstream(folder / "study.yaml") << "name: tube\nsurface: {file: tube.stl, unit: cm}\n"
                                          "openings:\n  in: {near: [4, 0, 0]}\n  out: {near: [-2, 3.46, 0]}\n"
                                          "inlet: in\nedges: {longest: 3 mm}\n"
                                       << more;
  return folder;
}

ChildEnd built(const fs::path& folder) {
  return capture(
      {{TETHER_PROGRAM, "build-model", (folder / "study.yaml").string(), "--output", (folder / "out").string()}, {}});
}

TEST(BuildModel, WritesSurfaceCentrelineAndSummary) {
  const fs::path folder = study_with("", testing::bent_tube());
  const ChildEnd end = built(folder);
  ASSERT_EQ(end.exit_code, exit_done) << end.errors;
  const auto summary = read_record<SurfaceSummary>(folder / "out" / "surface.json");
  EXPECT_EQ(summary.openings.size(), 2U);
  EXPECT_EQ(summary.branches.at(0).name, "out");
  for (const char* file : {"surface.vtp", "centreline.vtp", "centreline.csv", "1_read.vtp", "4_closed.vtp"})
    EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;
}

/// From a surface to a mesh that `tether` takes, by one command.
TEST(BuildModel, WritesAModelThatRuns) {
  const fs::path folder = study_with("model: {wall: {thickness: 1 mm}}\n", testing::bent_tube());
  const ChildEnd end = built(folder);
  ASSERT_EQ(end.exit_code, exit_done) << end.errors;
  const auto quality = read_record<ModelQuality>(folder / "out" / "model" / "quality.json");
  EXPECT_GT(quality.blood.least_dihedral, 5);
  EXPECT_GT(quality.wall.least_jacobian, 0.1);
  EXPECT_NEAR(quality.thickness.mean, 0.1, 1e-3);
  const ChildEnd valid = capture({{TETHER_PROGRAM, "validate", (folder / "out" / "model" / "case.yaml").string()}, {}});
  EXPECT_EQ(valid.exit_code, exit_done) << valid.errors;

  std::ofstream(folder / "out" / "model" / "mine.txt") << "mine";
  std::ofstream(folder / "study.yaml") << "name: tube\nsurface: {file: tube.stl, unit: cm}\n"
                                          "openings:\n  in: {near: [4, 0, 0]}\n  out: {near: [-2, 3.46, 0]}\n"
                                          "inlet: in\nedges: {longest: 3 mm}\n";
  const ChildEnd without = built(folder);
  EXPECT_EQ(without.exit_code, exit_done) << without.errors;
  const fs::directory_iterator left(folder / "out" / "model");
  EXPECT_EQ(std::distance(left, {}), 1) << "the model was of another surface";
  EXPECT_TRUE(fs::exists(folder / "out" / "model" / "mine.txt"));
}

/// Of measured contours, as configs/descending_aorta/study.yaml has them.
TEST(BuildModel, MakesAModelThroughContours) {
  const fs::path& folder = test_folder();
  const fs::path contours = fs::path(TETHER_SOURCE) / "configs/descending_aorta/cine_mr/contours.csv";
  std::ofstream(folder / "study.yaml") << "name: aorta\ncontours: {file: " << contours.string()
                                       << ", unit: mm, extend: {inlet: 1 cm, outlet: 1 cm}}\n"
                                          "openings: {in: {label: 1}, out: {label: 2}}\ninlet: in\n"
                                          "edges: {longest: 4 mm}\nmodel: {wall: {thickness: 1.5 mm}}\n";
  const ChildEnd end = built(folder);
  ASSERT_EQ(end.exit_code, exit_done) << end.errors;
  const auto summary = read_record<SurfaceSummary>(folder / "out" / "surface.json");
  ASSERT_EQ(summary.openings.size(), 2U);
  EXPECT_GT(summary.openings[0].centre.z(), summary.openings[1].centre.z()) << "the first contour is the uppermost";
  EXPECT_NEAR(summary.branches.at(0).length, 6.8, 0.3);  // the contours' middles are 4.8 cm apart along the vessel
  const std::string model = (folder / "out" / "model" / "case.yaml").string();
  const ChildEnd valid = capture({{TETHER_PROGRAM, "validate", model}, {}});
  EXPECT_EQ(valid.exit_code, exit_done) << valid.errors;

  std::ofstream(folder / "study.yaml", std::ios::app) << "surface: {file: " << contours.string() << ", unit: mm}\n";
  const ChildEnd both = built(folder);
  EXPECT_EQ(both.exit_code, exit_input_wrong);
  EXPECT_NE(both.errors.find("surface: or image or contours must be given, one of them"), std::string::npos)
      << both.errors;
}

TEST(BuildModel, LeavesFilesOfOthersAlone) {
  const fs::path folder = study_with("", testing::bent_tube());
  fs::create_directories(folder / "out" / "model");
  std::ofstream(folder / "out" / "model" / "case.yaml") << "precious";
  std::ofstream(folder / "out" / "surface.vtp") << "precious";
  const ChildEnd end = built(folder);
  EXPECT_EQ(end.exit_code, exit_input_wrong);
  EXPECT_EQ(end.errors, (folder / "out").string() +
                            ": holds files that are not what tether build-model made; choose another folder with "
                            "--output, or give --overwrite\n");
  for (const char* name : {"surface.vtp", "model/case.yaml"}) EXPECT_EQ(fs::file_size(folder / "out" / name), 8U);
}

TEST(BuildModel, MarksThePlaceOfWhatItRefuses) {
  RawSurface hole = testing::bent_tube();
  for (int row = 3; row >= 0; --row) {
    const auto first = hole.triangles.begin() + 1280 + 64 * row;
    hole.triangles.erase(first, first + 14);
  }
  const fs::path folder = study_with("", hole);
  const ChildEnd end = built(folder);
  EXPECT_EQ(end.exit_code, exit_input_wrong);
  EXPECT_NE(end.errors.find("places.vtp"), std::string::npos) << end.errors;
  EXPECT_TRUE(fs::exists(folder / "out" / "places.vtp"));
  EXPECT_FALSE(fs::exists(folder / "out" / "surface.vtp"));
}

TEST(BuildModel, MistakesOfTheFileAreToldWithTheirLines) {
  const fs::path folder = study_with("trunk: nowhere\nrepare: {}\n", testing::bent_tube());
  std::string message;
  try {
    read_study(folder / "study.yaml");
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_NE(message.find("study.yaml:9: repare: unknown field; did you mean 'repair'?"), std::string::npos) << message;
  EXPECT_NE(message.find("must be one of the other openings"), std::string::npos) << message;
}

TEST(BuildModel, DirectionsOfNoLengthAreToldWithTheirLines) {
  const fs::path folder = study_with(
      "model:\n  wall: {thickness: 1 mm}\n  regions:\n"
      "    arch: {planes: {a: {point: [0, 0, 0], normal: [0, 0, 0]}}}\n"
      "    spine: {angle: [0, 90], angle_origin: [0, 0, 0]}\n",
      testing::bent_tube());
  std::ifstream file(folder / "study.yaml");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  text.replace(text.find("near: [4, 0, 0]"), 15, "cut: {point: [4, 0, 0], outward: [0, 0, 0]}");
  std::ofstream(folder / "study.yaml") << text;
  std::string message;
  try {
    read_study(folder / "study.yaml");
  } catch (const InputError& error) {
    message = error.what();
  }
  for (const char* told : {"study.yaml:4: openings.in.cut.outward: must not be zero",
                           "study.yaml:11: model.regions.arch.planes.a.normal: must not be zero",
                           "study.yaml:12: model.regions.spine.angle_origin: must not be zero"})
    EXPECT_NE(message.find(told), std::string::npos) << message;
}

TEST(BuildModel, BranchesThatAreNoneAreToldBeforeAnythingIsBuilt) {
  const fs::path folder = study_with(
      "model:\n  wall: {thickness: 2 mm, branches: {carotid: {thickness: 1 mm}}}\n"
      "  regions: {arch: {branches: [trunk]}}\n",
      testing::bent_tube());
  std::string message;
  try {
    read_study(folder / "study.yaml");
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_NE(message.find("study.yaml:9: model.wall.branches: there is no branch 'carotid'"), std::string::npos)
      << message;
  EXPECT_NE(message.find("study.yaml:10: model.regions.arch.branches: there is no branch 'trunk'"), std::string::npos)
      << message;
}

TEST(BuildModel, AMergeThatLeavesNothingIsToldWithItsLine) {
  const ChildEnd end = built(study_with("repair: {merge: 20}\n", testing::bent_tube()));
  EXPECT_EQ(end.exit_code, exit_input_wrong);
  EXPECT_NE(end.errors.find("study.yaml:8: repair.merge: 20 cm: leaves no triangle"), std::string::npos) << end.errors;
  const ChildEnd beyond = built(study_with("repair: {merge: 1e300}\n", testing::bent_tube()));
  EXPECT_EQ(beyond.exit_code, exit_input_wrong);
  EXPECT_NE(beyond.errors.find("study.yaml:8: repair.merge: 1e300 cm: must be at least 1e-09 and at most 100"),
            std::string::npos)
      << beyond.errors;
}

}  // namespace
}  // namespace tether
