#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "common/base/error.hpp"
#include "common/base/newest_state.hpp"
#include "common/base/progress_line.hpp"
#include "fsi_master/checkpoint.hpp"
#include "fsi_master/old_results.hpp"
#include "fsi_master/progress.hpp"
#include "fsi_master/time_series.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test.
class Output : public ::testing::Test {
 protected:
  std::string content(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder / name).rdbuf();
    return text.str();
  }
  const TemporaryFolder temporary;
  const fs::path folder = temporary.path();
};

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

const std::vector<Column> columns{
    {"time", "s"}, {"fluid.outlet.pressure", "g/(cm s2)"}, {"fluid.outlet.flow", "cm3/s"}, {"residual", ""}};

TEST_F(Output, TableHasUnitsAndClinicalCopiesOfOtherNumbersOnly) {
  TimeSeries series(folder / "t.csv", columns, UnitSystem::cgs());
  series.start();
  series.append({0.1, 1333.22, 80, 1e-7});
  EXPECT_EQ(
      content("t.csv"),
      "time [s],fluid.outlet.pressure [g/(cm s2)],fluid.outlet.flow [cm3/s],residual,fluid.outlet.pressure [mmHg]\n"
      "0.1,1333.22,80,1e-07,1\n");
}

TEST_F(Output, ResumedTableDropsLaterRowsAndGoesOn) {
  std::uint64_t after_two = 0;
  for (double last : {3.0, 4.0}) {
    TimeSeries series(folder / "t.csv", {{"time", "s"}}, UnitSystem::si());
    if (last == 3) series.start();
    if (last == 4) series.resume(2, after_two);
    for (double time = last == 3 ? 1 : 3; time <= last; ++time) {
      series.append({time / 10});
      if (time == 2) after_two = series.checksum();
    }
  }
  EXPECT_EQ(content("t.csv"), "time [s]\n0.1\n0.2\n0.3\n0.4\n");
  TimeSeries other(folder / "t.csv", columns, UnitSystem::si());
  EXPECT_NE(error_of([&] { other.resume(2, after_two); }).find("other headings"), std::string::npos);
  TimeSeries longer(folder / "t.csv", {{"time", "s"}}, UnitSystem::si());
  EXPECT_NE(error_of([&] { longer.resume(9, 0); }).find("has 4 rows, the checkpoint 9"), std::string::npos);
}

Checkpoint some_checkpoint(std::int64_t step) {
  Checkpoint c{step, 77, {{1, 2.5}, {3}, {0.1, 0.2}, {4, 5}, "iqn_ils", {6}}, {}, "", "{}"};
  c.statistics.evaluations.add(3);
  c.statistics.pressure.add(1e4);
  c.statistics.wall_seconds = 0.125;
  return c;
}

TEST_F(Output, CheckpointIsReadBackExactly) {
  write_checkpoint(folder, some_checkpoint(7));
  const Checkpoint read = read_checkpoint(folder, 77);
  EXPECT_EQ(read.step, 7);
  EXPECT_EQ(read.snapshot.fluid, (std::vector<double>{1, 2.5}));
  EXPECT_EQ(read.snapshot.solid, (std::vector<double>{3}));
  EXPECT_EQ(read.snapshot.displacement, (std::vector<double>{0.1, 0.2}));
  EXPECT_EQ(read.snapshot.velocity, (std::vector<double>{4, 5}));
  EXPECT_EQ(read.snapshot.coupling, (std::vector<double>{6}));
  EXPECT_EQ(read.statistics.evaluations.max, 3);
  EXPECT_EQ(read.statistics.pressure.min, 1e4);
  EXPECT_EQ(read.statistics.wall_seconds, 0.125);
  EXPECT_EQ(read.coupling, "{}");
}

TEST_F(Output, TheCheckpointBeforeIsKeptAndFoundIfTheNewestIsMissing) {
  write_checkpoint(folder, some_checkpoint(7));
  write_checkpoint(folder, some_checkpoint(8));
  EXPECT_EQ(read_checkpoint(folder, 77).step, 8);
  fs::remove_all(folder / "checkpoint");  // as if stopped between the two renames
  EXPECT_EQ(read_checkpoint(folder, 77).step, 7);
}

/// Two verbs may share a folder: a run's states change places, and go, without an identification's.
TEST_F(Output, WhatAnIdentificationSavedStays) {
  fs::create_directories(folder / "checkpoint");
  std::ofstream(folder / "checkpoint/identification.bin") << "saved";
  for (const int step : {7, 8}) {
    write_checkpoint(folder, some_checkpoint(step));
    EXPECT_EQ(content("checkpoint/identification.bin"), "saved");
    EXPECT_FALSE(fs::exists(folder / "checkpoint.previous/identification.bin")) << "an old one would be taken for it";
  }
  EXPECT_EQ(read_checkpoint(folder, 77).step, 8);

  fs::rename(folder / "checkpoint", folder / "checkpoint.new");  // killed between the two renames
  remove_checkpoints(folder);
  EXPECT_EQ(content("checkpoint/identification.bin"), "saved");
  for (const char* gone : {"checkpoint/master.bin", "checkpoint.new", "checkpoint.previous"})
    EXPECT_FALSE(fs::exists(folder / gone)) << gone;
  fs::remove(folder / "checkpoint/identification.bin");
  write_checkpoint(folder, some_checkpoint(9));
  remove_checkpoints(folder);
  EXPECT_FALSE(fs::exists(folder / "checkpoint"));
}

TEST_F(Output, WhatAPersonPutsBesideStatesStays) {
  const auto put = [&](const fs::path& file) {
    fs::create_directories((folder / file).parent_path());
    std::ofstream(folder / file) << file.string();
  };
  const auto saved = [&](const fs::path& file) { return content("checkpoint" / file); };
  write_checkpoint(folder, some_checkpoint(7));
  write_checkpoint(folder, some_checkpoint(8));
  for (const char* file : {"checkpoint/note", "checkpoint/kept/note", "checkpoint.previous/other",
                           "checkpoint.previous/older/note", "checkpoint.previous/note"})
    put(file);
  write_checkpoint(folder, some_checkpoint(9));
  write_checkpoint(folder, some_checkpoint(10));
  EXPECT_EQ(read_checkpoint(folder, 77).step, 10);
  put("checkpoint.previous/last");
  const auto expect_all = [&] {
    EXPECT_EQ(saved("note"), "checkpoint/note");
    EXPECT_EQ(saved("kept/note"), "checkpoint/kept/note");
    EXPECT_EQ(saved("note.previous"), "checkpoint.previous/note");
    EXPECT_EQ(saved("other"), "checkpoint.previous/other");
    EXPECT_EQ(saved("older/note"), "checkpoint.previous/older/note");
  };
  expect_all();
  remove_checkpoints(folder);
  expect_all();
  EXPECT_EQ(saved("last"), "checkpoint.previous/last");
  EXPECT_FALSE(fs::exists(folder / "checkpoint/master.bin"));
  EXPECT_FALSE(fs::exists(folder / "checkpoint.previous"));
  write_checkpoint(folder, some_checkpoint(11));
  remove_states(folder);
  expect_all();
  EXPECT_FALSE(fs::exists(folder / "checkpoint/master.bin"));
}

TEST_F(Output, ANewRunTakesAwayFramesAndNothingOfAPerson) {
  fs::create_directories(folder / "vtk/thick");
  fs::create_directories(folder / "elsewhere");
  fs::create_directories(folder / "plots");
  fs::create_symlink("wall_loop.png", folder / "plots/wall_loop.png");
  for (const char* name : {"vtk/fluid_000020.vtu", "vtk/solid_1000000.vtu", "vtk/solid_000030.vtu.part",
                           "vtk/view.pvsm", "vtk/thick/summary.json", "vtk/thick/solid_000020.vtu",
                           "elsewhere/solid_000020.vtu", "summary.json", "fluid.pvd"})
    std::ofstream(folder / name) << name;
  remove_old_results(folder);
  for (const char* gone :
       {"vtk/fluid_000020.vtu", "vtk/solid_1000000.vtu", "vtk/solid_000030.vtu.part", "summary.json", "fluid.pvd"})
    EXPECT_FALSE(fs::exists(folder / gone)) << gone;
  for (const char* kept : {"vtk/view.pvsm", "vtk/thick/summary.json", "vtk/thick/solid_000020.vtu"})
    EXPECT_EQ(content(kept), kept);
  fs::remove_all(folder / "vtk");
  fs::create_directory_symlink(folder / "elsewhere", folder / "vtk");
  remove_old_results(folder);
  EXPECT_FALSE(fs::exists(fs::symlink_status(folder / "vtk")));
  EXPECT_EQ(content("elsewhere/solid_000020.vtu"), "elsewhere/solid_000020.vtu");
  fs::create_directories(folder / "vtk");
  std::ofstream(folder / "vtk/solid_000020.vtu") << "old";
  remove_old_results(folder);
  EXPECT_FALSE(fs::exists(folder / "vtk"));
}

TEST_F(Output, RefusedCheckpointsSayWhy) {
  EXPECT_NE(error_of([&] { read_checkpoint(folder, 77); }).find("holds no checkpoint"), std::string::npos);
  Checkpoint stateless = some_checkpoint(7);
  stateless.without_state = "the fluid (box 1)";
  write_checkpoint(folder, stateless);
  EXPECT_NE(error_of([&] { read_checkpoint(folder, 77); }).find("the fluid (box 1) announced no state"),
            std::string::npos);
  EXPECT_NE(error_of([&] { read_checkpoint(folder, 78); }).find("another case, step, mesh or code"), std::string::npos);
}

TEST_F(Output, DamagedCheckpointsAreNoticed) {
  write_checkpoint(folder, some_checkpoint(7));
  const fs::path file = folder / "checkpoint" / "fluid.bin";
  const auto size = static_cast<std::streamoff>(fs::file_size(file));
  std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(size - 1).put('x');
  EXPECT_NE(error_of([&] { read_checkpoint(folder, 77); }).find("fluid.bin: is damaged (checksum)"), std::string::npos);
  fs::resize_file(file, fs::file_size(file) - 3);
  EXPECT_NE(error_of([&] { read_checkpoint(folder, 77); }).find("fluid.bin: is cut short"), std::string::npos);
}

/// Each of them whole, of the same case and step.
TEST_F(Output, StatesOfDifferentRunsAreNoCheckpoint) {
  for (const char* file : {"fluid.bin", "solid.bin"}) {
    Checkpoint other = some_checkpoint(8);
    for (std::vector<double>* state : {&other.snapshot.fluid, &other.snapshot.solid}) state->at(0) += 1;
    write_checkpoint(folder, other);
    fs::copy_file(folder / "checkpoint" / file, folder / file);
    write_checkpoint(folder, some_checkpoint(7));
    write_checkpoint(folder, some_checkpoint(8));
    fs::rename(folder / file, folder / "checkpoint" / file);
    const Checkpoint taken = read_checkpoint(folder, 77);
    EXPECT_EQ(taken.step, 7);
    EXPECT_NE(taken.refused.find("checkpoint: holds states of different runs"), std::string::npos) << taken.refused;
  }
}

TEST_F(Output, TheCheckpointBeforeIsTakenIfTheNewestIsDamaged) {
  write_checkpoint(folder, some_checkpoint(7));
  write_checkpoint(folder, some_checkpoint(8));
  fs::resize_file(folder / "checkpoint/solid.bin", fs::file_size(folder / "checkpoint/solid.bin") - 3);
  const Checkpoint taken = read_checkpoint(folder, 77);
  EXPECT_EQ(taken.step, 7);
  EXPECT_NE(taken.refused.find("checkpoint/solid.bin: is cut short"), std::string::npos) << taken.refused;
  EXPECT_NE(error_of([&] { read_checkpoint(folder); }).find("is cut short"), std::string::npos)
      << "another run would begin with another state";
  write_checkpoint(folder, some_checkpoint(9));
  EXPECT_EQ(read_checkpoint(folder, 77).refused, "");
}

/// A bit of any byte: version, case, step, size and checksum stand in the first 48.
TEST_F(Output, NoByteOfACheckpointsHeaderCanBeAnother) {
  write_checkpoint(folder, some_checkpoint(7));
  write_checkpoint(folder, some_checkpoint(8));
  const fs::path file = folder / "checkpoint/master.bin";
  const std::string whole = content("checkpoint/master.bin");
  for (std::size_t i = 0; i < 48; ++i) {
    std::string flipped = whole;
    flipped[i] = static_cast<char>(flipped[i] ^ 0x10);
    std::ofstream(file, std::ios::binary) << flipped;
    const Checkpoint taken = read_checkpoint(folder, 77);
    EXPECT_EQ(taken.step, 7) << "byte " << i;
    EXPECT_NE(taken.refused.find("checkpoint/master.bin: "), std::string::npos) << taken.refused;
  }
}

TEST_F(Output, ACheckpointThatWasNotPutInItsPlaceIsTaken) {
  const auto damage = [&](const char* name) {
    fs::resize_file(folder / name / "solid.bin", fs::file_size(folder / name / "solid.bin") - 3);
  };
  write_checkpoint(folder, some_checkpoint(9));
  fs::rename(folder / "checkpoint", folder / "checkpoint.new");
  fs::create_directory(folder / "other");
  write_checkpoint(folder / "other", some_checkpoint(8));
  fs::rename(folder / "other/checkpoint", folder / "checkpoint");
  damage("checkpoint");  // and the one before it had to make room: killed just then
  EXPECT_EQ(read_checkpoint(folder, 77).step, 9);
  EXPECT_EQ(newest_state(folder), folder / "checkpoint.new") << "what depends on a state asks here which one is read";
  const fs::path next = folder.string() + "_next";
  fs::remove_all(next);
  fs::copy(folder, next, fs::copy_options::recursive);
  write_checkpoint(next, some_checkpoint(10));
  const std::optional<Checkpoint> kept = checkpoint_before(next, some_checkpoint(10));
  ASSERT_TRUE(kept) << "the only one that was whole may not make room before the next one is";
  EXPECT_EQ(kept->step, 9);
  damage("checkpoint.new");
  EXPECT_EQ(newest_state(folder), folder / "checkpoint");
  EXPECT_NE(error_of([&] { read_checkpoint(folder, 77); }).find("there is none before it"), std::string::npos);
  EXPECT_NE(error_of([&] { read_checkpoint(folder, 77); }).find("start anew without --resume"), std::string::npos);
}

TEST_F(Output, AStateToBeginWithIsTheNewestOfARun) {
  fs::create_directories(folder / "checkpoint");
  std::ofstream(folder / "checkpoint/identification.bin") << "of another kind";
  const std::string none = error_of([&] { read_checkpoint(folder); });
  EXPECT_TRUE(none.ends_with("holds no checkpoint of a run")) << none;
  write_checkpoint(folder, some_checkpoint(8));
  write_checkpoint(folder, some_checkpoint(9));
  EXPECT_EQ(read_checkpoint(folder).step, 9);
  std::ofstream(folder / "checkpoint/solid.bin") << "damaged";
  const std::string damaged = error_of([&] { read_checkpoint(folder); });
  EXPECT_TRUE(
      damaged.ends_with("; the state before it, of step 8, is whole: let that run go on from it (--resume) "
                        "first"))
      << damaged;
}

TEST(Fingerprint, CountsPhysicsAndMeshButNotWhereAndHowLong) {
  const auto of = [](const std::string& text, double x = 1) {
    return fingerprint({text}, 0.1, Points::Constant(3, 2, x));
  };
  const auto a = of(R"({"fluid": {"density": 1.06, "curve": "/home/a/in.csv"}, "time": {"step": 1, "end": 2}})");
  EXPECT_EQ(
      a,
      of(R"({"fluid": {"density": 1.06, "curve": "/data/in.csv"}, "time": {"step": 1, "end": 3}, "output": {"write_every": 2}})"));
  EXPECT_NE(a, of(R"({"fluid": {"density": 1.05, "curve": "/home/a/in.csv"}, "time": {"step": 1, "end": 2}})"));
  EXPECT_NE(of("{}"), of("{}", 1.0000001));
}

TEST(Progress, DurationsReadLikeSpeech) {
  EXPECT_EQ(duration_text(12.4), "12 s");
  EXPECT_EQ(duration_text(200), "3 min 20 s");
  EXPECT_EQ(duration_text(3900), "1 h 05 min");
}

}  // namespace
}  // namespace tether
