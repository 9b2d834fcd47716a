#include "diagnosis/explanation/explained_steps.hpp"

#include "common/base/error.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// Whether steps are made anew, each seen by its own memory of the output folder.
class ExplainedStepsTest : public ::testing::Test {
 protected:
  ExplainedStepsTest() {
    fs::create_directories(folder / "out/model_0");
    folder.file("frame.stl", "solid");
    folder.file("frames.csv", "file, time [s]\nframe.stl, 0\n");
    folder.file("case.yaml", "name: tube\nunits: cgs\nobservations: {surfaces: {ct: {file: frames.csv}}}\n");
  }
  bool is_made(std::uint64_t asked = 0) const {
    bool made = false;
    const InputWatch inputs(folder / "case.yaml");
    ExplainedSteps steps(folder / "out", inputs, true);
    steps.make(
        "model 0", folder / "case.yaml", "model_0", "comparison.json",
        [&](bool) {
          made = true;
          folder.file("out/model_0/comparison.json", "{}");
        },
        asked);
    return made;
  }
  TemporaryFolder folder;
};

TEST_F(ExplainedStepsTest, AreKeptForTheSameContent) {
  EXPECT_TRUE(is_made());
  EXPECT_FALSE(is_made());
  const auto later = fs::file_time_type::clock::now() + std::chrono::hours(1);
  for (const char* name : {"frame.stl", "frames.csv", "case.yaml"}) fs::last_write_time(folder / name, later);
  EXPECT_FALSE(is_made()) << "dates tell nothing";
}

TEST_F(ExplainedStepsTest, AreMadeAnewForOtherContent) {
  EXPECT_TRUE(is_made());
  folder.file("frame.stl", "another solid");
  fs::last_write_time(folder / "frame.stl", fs::file_time_type::clock::now() - std::chrono::hours(1));
  EXPECT_TRUE(is_made()) << "a surface behind a table";
  folder.file("frames.csv", "file, time [s]\nframe.stl, 0.1\n");
  EXPECT_TRUE(is_made()) << "the table";
  EXPECT_TRUE(is_made(1)) << "what else was asked";
  fs::remove(folder / "out/model_0/comparison.json");
  EXPECT_TRUE(is_made(1)) << "its result is gone";
}

/// What a step left is read later, and an emptied file may read as nothing found.
TEST_F(ExplainedStepsTest, WhoseResultsAreDamagedAreMadeAnew) {
  EXPECT_TRUE(is_made());
  for (const char* damaged : {"", "{", "null"}) {
    folder.file("out/model_0/comparison.json", damaged);
    EXPECT_TRUE(is_made()) << damaged;
    EXPECT_FALSE(is_made()) << damaged;
  }
  folder.file("out/model_0/notes.csv", "of the user's own");
  EXPECT_FALSE(is_made());
  EXPECT_TRUE(fs::exists(folder / "out/model_0/notes.csv"));
}

/// A step that is made again, or a person who breaks the path off behind it, does not forget the later ones.
TEST_F(ExplainedStepsTest, AreKeptBehindOneThatIsMadeAgain) {
  const auto made = [&](std::size_t until) {
    std::vector<std::string> all;
    const InputWatch inputs(folder / "case.yaml");
    ExplainedSteps steps(folder / "out", inputs, true);
    const std::vector<std::string> names{"model_0", "diagnosis_0", "model_1"};
    for (std::size_t i = 0; i < until; ++i) {
      fs::create_directories(folder / "out" / names[i]);
      steps.make(names[i], folder / "case.yaml", names[i], "result.json", [&](bool) {
        all.push_back(names[i]);
        folder.file("out/" + names[i] + "/result.json", "{}");
      });
    }
    return all;
  };
  EXPECT_EQ(made(3).size(), 3U);
  folder.file("out/model_0/result.json", "damaged");
  EXPECT_EQ(made(1), std::vector<std::string>{"model_0"});
  EXPECT_EQ(made(3), std::vector<std::string>{});
}

/// What it read before and after is not known: it is not among the steps that were made.
TEST_F(ExplainedStepsTest, DuringWhichAFileIsWrittenAreNone) {
  const InputWatch inputs(folder / "case.yaml");
  ExplainedSteps steps(folder / "out", inputs, true);
  const auto write = [&](bool) {
    folder.file("out/model_0/comparison.json", "{}");
    folder.file("frame.stl", "solid");
  };
  try {
    steps.make("model 0", folder / "case.yaml", "model_0", "comparison.json", write);
    ADD_FAILURE() << "nothing was told";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("frame.stl: was written during the run"), std::string::npos);
  }
  EXPECT_TRUE(steps.all().empty());
  EXPECT_TRUE(is_made());
}

/// The explanation holds data that it has read, also between its steps: the next is not made of others.
TEST_F(ExplainedStepsTest, AreNotMadeOnceAFileOfTheExplanationIsWritten) {
  const InputWatch inputs(folder / "case.yaml");
  folder.file("overlay.yaml", "base: case.yaml\n");
  ExplainedSteps steps(folder / "out", inputs, true);
  folder.file("frames.csv", "file, time [s]\nframe.stl, 0.1\n");
  const auto act = [](bool) { ADD_FAILURE() << "was made"; };
  try {
    steps.make("model 0", folder / "overlay.yaml", "model_0", "comparison.json", act);
    ADD_FAILURE() << "nothing was told";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("frames.csv: was written during the run"), std::string::npos);
  }
}

/// A step that was broken off goes on from its own checkpoint, never from another's in the same folder.
TEST_F(ExplainedStepsTest, GoOnFromTheirOwnCheckpointsOnly) {
  const InputWatch inputs(folder / "case.yaml");
  const auto began_with = [&](std::uint64_t asked) {
    bool begun = false, is_there = false;
    ExplainedSteps steps(folder / "out", inputs, true);
    try {
      steps.make(
          "model 0", folder / "case.yaml", "model_0", "comparison.json",
          [&](bool was_begun) {
            begun = was_begun;
            is_there = fs::exists(folder / "out/model_0/checkpoint/identification.bin");
            fs::create_directories(folder / "out/model_0/checkpoint");
            folder.file("out/model_0/checkpoint/identification.bin", "of this step");
            throw ToldFailure(exit_run_failed);
          },
          asked);
    } catch (const RunError&) {
    }
    return std::pair(begun, is_there);
  };
  EXPECT_EQ(began_with(1), std::pair(false, false));
  EXPECT_EQ(began_with(1), std::pair(true, true));
  EXPECT_EQ(began_with(2), std::pair(false, false)) << "other data, or another question";
  EXPECT_EQ(began_with(2), std::pair(true, true));
  EXPECT_TRUE(is_made(2));
  fs::remove(folder / "out/model_0/comparison.json");
  EXPECT_EQ(began_with(2), std::pair(false, false)) << "it was made, and what it left is gone";
}

TEST_F(ExplainedStepsTest, OfADamagedMemoryAreMadeAnew) {
  for (const char* damaged : {"", "{", "[{}]", "{\"steps\": [{}]}", "null", "\xFF\xFE"}) {
    folder.file("out/steps.json", damaged);
    EXPECT_TRUE(is_made()) << damaged;
    EXPECT_FALSE(is_made()) << damaged;
  }
}

}  // namespace
}  // namespace tether
