#include "common/config/input_files.hpp"

#include <sys/stat.h>

#include "common/base/checked_file.hpp"
#include "common/base/newest_state.hpp"
#include "common/config/overlay.hpp"
#include "tests/config/case_text.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

class InputFiles : public ::testing::Test {
 protected:
  InputFiles() {
    for (const char* folder : {"data", "mesh", "mesh/surfaces"}) fs::create_directories(test_folder() / folder);
  }
  /// The hash of the path before and after a file is written.
  static bool changes(const std::string& path, const std::string& file, const std::string& text) {
    const std::uint64_t before = hash_content(test_folder() / path);
    write_file(file, text);
    return hash_content(test_folder() / path) != before;
  }
};

TEST_F(InputFiles, CountByWhatTheyHold) {
  EXPECT_TRUE(changes("flow.csv", "flow.csv", "t, q\n0, 1\n"));
  EXPECT_FALSE(changes("flow.csv", "flow.csv", "t, q\n0, 1\n")) << "written again";
  EXPECT_TRUE(changes("flow.csv", "flow.csv", "t, q\n0, 2\n"));
}

TEST_F(InputFiles, CountWithTheFilesThatTheyName) {
  write_file("data/a b.vtp", "one");
  write_file("data/2.vtp", "two");
  write_file("data/list.csv", "file, time [s]\na b.vtp, 0\n\"2.vtp\", 0.1\n");
  write_file("data/list.pvd", "<DataSet timestep=\"0\" file=\"2.vtp\"/>\n");
  write_file("data/LIST.PVD", "<DataSet timestep='0' file='2.vtp'/>\n");
  EXPECT_TRUE(changes("data/list.csv", "data/a b.vtp", "other"));
  EXPECT_TRUE(changes("data/list.csv", "data/2.vtp", "other"));
  EXPECT_TRUE(changes("data/list.pvd", "data/2.vtp", "yet another"));
  EXPECT_TRUE(changes("data/LIST.PVD", "data/2.vtp", "and another"));
  EXPECT_FALSE(changes("data/list.csv", "data/3.vtp", "not named"));
}

/// Names may hold what tables and series are made of.
TEST_F(InputFiles, CountWithFilesOfAnyName) {
  write_file("data/patient's 1.vtp", "one");
  write_file("data/a&b.vtp", "two");
  write_file("data/x;y.vtp", "three");
  write_file("data/list.csv", "file, time [s]\npatient's 1.vtp, 0\nx;y.vtp, 1\n");
  write_file("data/list.pvd", "<DataSet timestep=\"0\" file=\"a&amp;b.vtp\"/><DataSet file=\"patient's 1.vtp\"/>\n");
  EXPECT_TRUE(changes("data/list.csv", "data/patient's 1.vtp", "other"));
  EXPECT_TRUE(changes("data/list.csv", "data/x;y.vtp", "other"));
  EXPECT_TRUE(changes("data/list.pvd", "data/a&b.vtp", "other"));
  EXPECT_TRUE(changes("data/list.pvd", "data/patient's 1.vtp", "yet another"));
}

/// A folder of surfaces may hold the output of a run; only where a case begins from a run does its state stand for it.
TEST_F(InputFiles, OfARunTheStateCountsWhereACaseBeginsFromIt) {
  fs::create_directories(test_folder() / "data/checkpoint");
  write_file("data/checkpoint/solid.bin", "state");
  write_file("data/checkpoint/fluid.bin", "state");
  EXPECT_TRUE(changes("data", "data/lumen_1.vtp", "surface"));
  const fs::path file = write_file("case.yaml", "name: tube\ninitial_state: {run: data}\n");
  const auto content = [&] { return input_files(file).front().content; };
  const std::uint64_t before = content();
  write_file("data/summary.json", "what it has cost");
  EXPECT_EQ(content(), before);
  write_file("data/checkpoint/solid.bin", "another state");
  EXPECT_NE(content(), before);
  fs::remove(test_folder() / "data/checkpoint/solid.bin");
  ASSERT_EQ(mkfifo((test_folder() / "data/checkpoint/solid.bin").c_str(), 0600), 0);
  EXPECT_NE(content(), before) << "a pipe, which is not waited for";
}

/// A run that is killed just before it puts its newest state in its place leaves it whole beside the one before.
TEST_F(InputFiles, OfARunThatWasKilledTheStateCountsThatIsRead) {
  const fs::path file = write_file("case.yaml", "name: tube\ninitial_state: {run: data}\n");
  const auto save = [](const char* name, int value) {
    const fs::path folder = test_folder() / "data" / name;
    fs::create_directories(folder);
    const std::vector<std::byte> fluid{std::byte(value)}, solid{std::byte(2 * value)};
    const std::uint64_t states = hash_of_states(fluid, solid);
    write_checked(folder / "fluid.bin", 1, value, fluid);
    write_checked(folder / "solid.bin", 1, value, solid);
    write_checked(folder / "master.bin", 1, value, std::as_bytes(std::span(&states, 1)));
  };
  const auto content = [&] { return input_files(file).front().content; };
  save("checkpoint", 8);
  const std::uint64_t before = content();
  save("checkpoint.new", 9);
  const std::uint64_t fresh = content();
  EXPECT_NE(fresh, before);
  fs::remove_all(test_folder() / "data/checkpoint");
  EXPECT_EQ(content(), fresh) << "it is taken where there is no other, too";
  fs::rename(test_folder() / "data/checkpoint.new", test_folder() / "data/checkpoint");
  EXPECT_EQ(content(), fresh) << "it is the same state in its place";
  save("checkpoint.new", 10);
  write_file("data/checkpoint.new/solid.bin", "cut");
  EXPECT_EQ(content(), fresh) << "what is not whole is not taken";
}

/// A table of contours is no list of files: what stands in each of its rows is not looked for on the disk.
TEST_F(InputFiles, AListIsSearchedForAsManyNamesAsOneMayHave) {
  std::string rows = "file, time [s]\n";
  for (int i = 0; i < 5000; ++i) rows += fmt::format("surface {}.vtp, {}\n", i, i);
  write_file("data/surface 4999.vtp", "one");
  EXPECT_EQ(files_named_in(write_file("data/list.csv", rows)).size(), 1U);
  std::string many;
  for (int i = 0; i < 100'000; ++i) many += fmt::format("slice {}, {}\n", i, i);
  EXPECT_EQ(files_named_in(write_file("data/list.csv", many + rows)).size(), 0U);
}

/// A mesh may stand beside its case, and results too.
TEST_F(InputFiles, AroundACaseTheFilesOfItsMeshCountAndResultsDoNot) {
  write_file("mesh/surfaces/inlet.vtp", "inlet");
  const fs::path file = write_file("mesh/case.yaml", "name: tube\nmesh: {fluid: .}\n");
  const auto content = [&] { return input_files(file).front().content; };
  const std::uint64_t before = content();
  fs::create_directories(test_folder() / "mesh/out/tube");
  fs::create_directories(test_folder() / "mesh/results");
  write_file("mesh/out/tube/summary.json", "results");
  write_file("mesh/results/case_as_run.yaml", "name: tube");
  write_file("mesh/results/summary.json", "results");
  EXPECT_EQ(content(), before);
  write_file("mesh/surfaces/inlet.vtp", "outlet");
  EXPECT_NE(content(), before);
}

TEST_F(InputFiles, CountWithAllThatIsInAFolder) {
  write_file("mesh/mesh.vtu", "mesh");
  EXPECT_TRUE(changes("mesh", "mesh/surfaces/wall.vtp", "wall"));
  EXPECT_TRUE(changes("mesh", "mesh/surfaces/wall.vtp", "another wall"));
  EXPECT_TRUE(changes("mesh", "mesh/frame_2.vtp", "one more"));
}

TEST_F(InputFiles, AreThoseThatACaseNames) {
  write_file("base.csv", "base");
  write_file("flow.csv", "flow");
  write_file("tube", "a file that is called as the case");
  write_file("base.yaml", "name: tube\nfluid: {inlets: {inlet: {curve: base.csv}}, wall: [flow.csv, other.csv]}\n");
  const fs::path file = write_file("over.yaml", "base: base.yaml\nname: tube\nmesh: {folder: mesh, here: .}\n");
  const std::vector<InputFile> found = input_files(file);
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found[0].field + " " + found[0].name, "fluid.inlets.inlet.curve base.csv");
  EXPECT_EQ(found[1].field + " " + found[1].name, "fluid.wall flow.csv");
  EXPECT_EQ(found[2].field + " " + found[2].name, "mesh.folder mesh");
  EXPECT_EQ(found[3].field + " " + found[3].name, "mesh.here .");
}

/// Results may stand below the case; surfaces that a pattern finds may stand beside it.
TEST_F(InputFiles, OfTheCasesOwnFolderAreThoseBesideIt) {
  const fs::path file = write_file("case.yaml", "name: tube\nobservations: {folder: ., pattern: 'frame_*.vtp'}\n");
  const auto content = [&] { return input_files(file).front().content; };
  const std::uint64_t before = content();
  write_file("mesh/result.csv", "made");
  EXPECT_EQ(content(), before);
  write_file("frame_1.vtp", "surface");
  EXPECT_NE(content(), before);
}

/// A case in a linked folder means by ../ what the system finds, as who reads it and whoever calls it from elsewhere.
TEST_F(InputFiles, BehindALinkAreThoseThatAreRead) {
  for (const char* name : {"store/ada", "patients"}) fs::create_directories(test_folder() / name);
  fs::create_directory_symlink("../store/ada", test_folder() / "patients/ada");
  write_file("store/flow.csv", "t, q\n0, 1\n");
  write_file("patients/flow.csv", "t, q\n0, 2\n");
  write_file("store/ada/case.yaml", valid_head + "fluid: {file: ../flow.csv}\nmesh: {fluid: gone/../case.yaml}\n");
  struct Section {
    std::filesystem::path file;
    void declare(Fields& f) { f.path("file", file, "a curve", Need::required); }
  };
  for (const char* folder : {"patients/ada", "store/ada"}) {
    const fs::path called = test_folder() / folder / "case.yaml";
    Section section;
    CaseFile file(called);
    file.read("fluid", section);
    EXPECT_TRUE(fs::equivalent(section.file, test_folder() / "store/flow.csv")) << section.file;
    const std::vector<InputFile> found = input_files(called);
    ASSERT_EQ(found.size(), 1U) << "a way through a folder that is not there leads nowhere";
    EXPECT_EQ(found[0].content, hash_content(section.file));
    EXPECT_TRUE(files_read(called).contains(section.file)) << section.file;
  }
}

/// A case that builds on another and is called by a way through a link: what the other names counts.
TEST_F(InputFiles, OfACaseCalledThroughALinkAreThoseThatItBuildsOnNames) {
  for (const char* name : {"store/a/ada", "patients", "base"}) fs::create_directories(test_folder() / name);
  fs::create_directory_symlink("../store/a/ada", test_folder() / "patients/ada");
  write_file("base/flow.csv", "t, q\n");
  write_file("base/case.yaml", "name: tube\nfluid: {file: flow.csv}\n");
  write_file("store/a/x.yaml", "base: ../../base/case.yaml\nname: x\n");
  for (const char* way : {"store/a/x.yaml", "patients/ada/../x.yaml"}) {
    const std::vector<InputFile> found = input_files(test_folder() / way);
    ASSERT_EQ(found.size(), 1U) << way;
    EXPECT_EQ(found[0].content, hash_content(test_folder() / "base/flow.csv"));
  }
}

/// A case that is written elsewhere, with one that it builds on, names the same files.
TEST_F(InputFiles, OfACaseThatBuildsOnOneBehindALinkAreTheSame) {
  for (const char* name : {"store/ada", "scratch/out"}) fs::create_directories(test_folder() / name);
  fs::create_directory_symlink("store/ada", test_folder() / "ada");
  fs::create_directory_symlink("scratch/out", test_folder() / "out");
  write_file("store/flow.csv", "t, q\n");
  write_file("store/ada/case.yaml", "name: tube\nfluid: {file: ../flow.csv}\n");
  write_overlay(test_folder() / "out/model.yaml", {test_folder() / "ada/case.yaml", "model", "", {}});
  const std::vector<InputFile> found = input_files(test_folder() / "out/model.yaml");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].content, hash_content(test_folder() / "store/flow.csv"));
}

/// What names a run: moved files are the same, changed ones are not.
TEST_F(InputFiles, CountInAnEffectiveCase) {
  const fs::path one = write_file("data/flow.csv", "t, q\n"), moved = write_file("mesh/flow.csv", "t, q\n");
  const auto named = [](const fs::path& file) { return hash_case("{\"curve\": \"" + file.string() + "\"}", 0); };
  EXPECT_EQ(named(one), named(moved));
  const std::uint64_t before = named(one);
  write_file("data/flow.csv", "t, Q\n");
  EXPECT_NE(named(one), before);
}

}  // namespace
}  // namespace tether
