#include "common/config/input_files.hpp"

#include "common/config/case_essence.hpp"
#include "tests/config/case_text.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

class InputFiles : public ::testing::Test {
 protected:
  InputFiles() {
    fs::remove_all(test_folder());
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
  EXPECT_TRUE(changes("data/list.csv", "data/a b.vtp", "other"));
  EXPECT_TRUE(changes("data/list.csv", "data/2.vtp", "other"));
  EXPECT_TRUE(changes("data/list.pvd", "data/2.vtp", "yet another"));
  EXPECT_FALSE(changes("data/list.csv", "data/3.vtp", "not named"));
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
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].field + " " + found[0].name, "fluid.inlets.inlet.curve base.csv");
  EXPECT_EQ(found[1].field + " " + found[1].name, "fluid.wall flow.csv");
  EXPECT_EQ(found[2].field + " " + found[2].name, "mesh.folder mesh") << "a folder that holds the case is no input";
  const fs::path record = test_folder() / "inputs.yaml";
  write_input_files(record, found);
  const auto again = read_input_files(record);
  ASSERT_TRUE(again);
  ASSERT_EQ(again->size(), 3U);
  EXPECT_EQ((*again)[1].field + " " + (*again)[1].name, "fluid.wall flow.csv");
  EXPECT_EQ((*again)[1].content, found[1].content);
  EXPECT_FALSE(read_input_files(test_folder() / "none.yaml"));
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
