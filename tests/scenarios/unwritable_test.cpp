/// `tether simulate` whose files cannot be written, from some call on: one message that names the file and the cause,
/// and the same command with --resume leaves what an undisturbed run leaves. The whole table: benchmarks/reliability.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <future>
#include <thread>

#include "common/base/child_process.hpp"
#include "tests/faults/fault.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/case_variant.hpp"
#include "tests/study/bent_tube.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

struct Unwritable {
  const char *name, *fault, *message;
  bool is_saved;  ///< a state, from which the run goes on
};

void PrintTo(const Unwritable& one, std::ostream* out) {
  *out << one.name;
}

class UnwritableFile : public ::testing::TestWithParam<Unwritable> {
 protected:
  UnwritableFile() {
    case_file_ = case_variant(TETHER_SOURCE "/configs/tube/case.yaml", folder_ / "case",
                              {{"around: 24", "around: 12"},
                               {"along: 20", "along: 8"},
                               {"write_every: 10", "write_every: 3"},
                               {"checkpoint_every: 100", "checkpoint_every: 4"}});
  }
  ChildEnd simulate(const std::string& output, const std::string& option,
                    std::vector<std::pair<std::string, std::string>> environment) const {
    environment.emplace_back("TETHER_PICTURES", "0");
    return capture({{TETHER_PROGRAM, "simulate", case_file_.string(), "--output", folder_ / output, "--steps", "12",
                     "--quiet", option},
                    std::move(environment)});
  }

  TemporaryFolder folder_;
  fs::path case_file_;
};

TEST_P(UnwritableFile, IsToldAndNothingIsLost) {
  const fs::path output = folder_ / "out";
  const ChildEnd end = simulate("out", "--overwrite", with_fault(GetParam().fault, output));
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_NE(end.errors.find(GetParam().message), std::string::npos) << end.errors;
  EXPECT_LE(std::count(end.errors.begin(), end.errors.end(), '\n'), 3) << end.errors;

  EXPECT_EQ(fs::exists(output / "checkpoint"), GetParam().is_saved);
  const ChildEnd again = simulate("out", GetParam().is_saved ? "--resume" : "--overwrite", {});
  ASSERT_EQ(again.exit_code, 0) << again.errors;
  ASSERT_EQ(simulate("whole", "--overwrite", {}).exit_code, 0);
  for (const char* name : {"timeseries.csv", "lumen.motion", "fluid.pvd", "vtk/solid_000012.vtu"})
    EXPECT_EQ(content_of(folder_ / "whole" / name), content_of(output / name)) << name;
}

INSTANTIATE_TEST_SUITE_P(
    Some, UnwritableFile,
    ::testing::Values(Unwritable{"Motion", "fsi_master:write:lumen.motion:7:ENOSPC",
                                 "lumen.motion: cannot be written: no space is left on its disk", false},
                      Unwritable{"Checkpoint", "fsi_master:write:checkpoint.new/fluid.bin:2:EDQUOT",
                                 "checkpoint.new/fluid.bin: cannot be written: Disk quota exceeded", true},
                      Unwritable{"Renaming", "fsi_master:rename:checkpoint:1:EIO", "Input/output error", false},
                      Unwritable{"OfAPartner", "solid:write:vtk/solid_000006:1:ENOSPC", "vtk/solid", true},
                      Unwritable{"Summary", "fsi_master:open:summary.json:1:EACCES",
                                 "summary.json: cannot be written: Permission denied", true}),
    [](const auto& info) { return std::string(info.param.name); });

/// A twin that is there stays whole until the next one is.
class UnwritableTwin : public ::testing::Test {
 protected:
  UnwritableTwin() {
    folder.file("model.yaml",
                fmt::format("base: {}/configs/tube/case.yaml\nname: model\n"
                            "time: {{step: 4e-3, end: 0.04}}\nmesh: {{swept: {{around: 12, along: 8}}}}\n",
                            TETHER_SOURCE));
    folder.file("same.yaml", "base: model.yaml\nname: same\n");
  }
  ChildEnd twin(int frames, const std::string& fault) const {
    const fs::path file =
        folder.file("twin.yaml", fmt::format("base: model.yaml\nname: twin\ntwin: {{truth: same.yaml, "
                                             "frames: {0}, noise: {{deviation: 0.0{0} mm, correlation_length: 5 mm}}, "
                                             "image: {{voxel: [0, 0, 0]}}, hidden: "
                                             "{{verdict: nothing_missing}}}}\n",
                                             frames));
    auto environment = with_fault(fault, folder / "out");
    environment.emplace_back("TETHER_FAULT_FLAG", (folder / "paused").string());
    return capture({{TETHER_PROGRAM, "twin", file.string(), "--output", (folder / "out").string(), "--quiet"},
                    std::move(environment)});
  }
  const TemporaryFolder folder;
};

/// What a person changes while the next twin is made is not replaced by it.
TEST_F(UnwritableTwin, KeepsWhatIsChangedMeanwhile) {
  ASSERT_EQ(twin(2, "none:write:none:1:ENOSPC").exit_code, 0);
  const fs::path frame = folder / "out/data/lumen_00.vtp";
  auto next = std::async(std::launch::async, [&] { return twin(3, "tether:open:.new_twin.yaml:1:PAUSE"); });
  const auto begun = std::chrono::steady_clock::now();
  while (!fs::exists(folder / "paused") && std::chrono::steady_clock::now() - begun < std::chrono::minutes(2))
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_TRUE(fs::exists(folder / "paused"));
  std::ofstream(frame) << "mine";
  fs::remove(folder / "paused");
  const ChildEnd end = next.get();
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_NE(end.errors.find(frame.string() + ": was changed while its next version was made, and is kept"),
            std::string::npos)
      << end.errors;
  EXPECT_EQ(content_of(frame), "mine");
  EXPECT_FALSE(fs::exists(folder / "out/data/lumen_02.vtp"));
}

TEST_F(UnwritableTwin, LeavesTheOneThatIsThere) {
  ASSERT_EQ(twin(2, "none:write:none:1:ENOSPC").exit_code, 0);
  const auto held = [&](const char* name) { return content_of(folder / "out" / name); };
  const std::string before = held("case.yaml") + held("data/lumen.csv") + held("data/lumen_00.vtp");
  for (const char* fault : {"tether:write:lumen_02.vtp:1:ENOSPC", "tether:open:.new_twin.yaml:1:EACCES"}) {
    const ChildEnd end = twin(4, fault);
    EXPECT_EQ(end.exit_code, 1);
    EXPECT_NE(end.errors.find("a twin that was there is as it was: the same command goes on"), std::string::npos)
        << end.errors;
    EXPECT_EQ(held("case.yaml") + held("data/lumen.csv") + held("data/lumen_00.vtp"), before);
    EXPECT_FALSE(fs::exists(folder / "out/.new_twin"));
  }
  EXPECT_EQ(twin(4, "none:write:none:1:ENOSPC").exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "out/data/lumen_03.vtp"));
  EXPECT_EQ(twin(5, "tether:write:made_by.txt:1:ENOSPC").exit_code, 1);
  EXPECT_EQ(twin(5, "none:write:none:1:ENOSPC").exit_code, 0) << "its case was nobody's";
  int frames = 5;
  for (const char* moment : {"write:made_by.txt", "rename:made_by.txt", "rename:lumen_00.vtp", "rename:lumen_03.vtp",
                             "rename:lumen.csv", "rename:sealed/answer", "rename:case.yaml"}) {
    frames = 9 - frames;
    EXPECT_EQ(twin(frames, fmt::format("tether:{}:1:KILL", moment)).exit_code, 128 + SIGKILL) << moment;
    const ChildEnd again = twin(frames, "none:write:none:1:ENOSPC");
    EXPECT_EQ(again.exit_code, 0) << moment << ": " << again.errors;
  }
}

/// What a verb makes of a file, which stays until all of it is made anew.
class UnwritableMade : public ::testing::Test {
 protected:
  ChildEnd made(const char* verb, const fs::path& file, const std::string& fault) const {
    return capture({{TETHER_PROGRAM, verb, file.string(), "--output", (folder_ / "out").string()},
                    with_fault(fault, folder_ / "out")});
  }
  std::string held(const std::vector<const char*>& names) const {
    std::string all;
    for (const char* name : names) all += content_of(folder_ / "out" / name);
    return all;
  }
  static constexpr const char* no_fault = "none:write:none:1:ENOSPC";
  TemporaryFolder folder_;
};

TEST_F(UnwritableMade, OutletsStayAndTheirCaseIsNobodys) {
  folder_.file("flow.csv", "time [s], flow [ml/s]\n0, 0\n0.1, 300\n0.2, 400\n0.3, 200\n0.4, 0\n0.6, 0\n0.8, 0\n");
  const auto outlets = [&](int pulse) {
    return folder_.file(
        "outlets.yaml",
        fmt::format("name: outlets\ncase: {}/configs/tube/case.yaml\nflow: {{file: flow.csv, value: flow, "
                    "period: 0.8}}\npressure: {{mean: 93 mmHg, pulse: {} mmHg}}\noutlets: {{outlet: "
                    "{{share: 1}}}}\n",
                    TETHER_SOURCE, pulse));
  };
  const ChildEnd first = made("fit-outlets", outlets(50), no_fault);
  ASSERT_EQ(first.exit_code, 0) << first.errors;
  const std::vector<const char*> files{"outlets.json", "outlets.csv", "case.yaml"};
  const std::string before = held(files);
  for (const char* fault : {"tether:write:outlets.csv:1:ENOSPC", "tether:write:case.yaml:1:ENOSPC"}) {
    EXPECT_EQ(made("fit-outlets", outlets(45), fault).exit_code, 1) << fault;
    EXPECT_EQ(held(files), before) << fault;
  }
  EXPECT_EQ(made("fit-outlets", outlets(45), "tether:write:made_by.txt:1:ENOSPC").exit_code, 1);
  const ChildEnd again = made("fit-outlets", outlets(45), no_fault);
  EXPECT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_NE(held(files), before);
}

TEST_F(UnwritableMade, ASurfaceAndItsModelStay) {
  testing::write_stl(folder_ / "tube.stl", testing::bent_tube());
  const auto study = [&](int longest) {
    return folder_.file("study.yaml",
                        fmt::format("name: tube\nsurface: {{file: tube.stl, unit: cm}}\nopenings:\n"
                                    "  in: {{near: [4, 0, 0]}}\n  out: {{near: [-2, 3.46, 0]}}\ninlet: in\n"
                                    "edges: {{longest: {} mm}}\nmodel: {{wall: {{thickness: 1 mm}}}}\n",
                                    longest));
  };
  const ChildEnd first = made("build-model", study(4), no_fault);
  ASSERT_EQ(first.exit_code, 0) << first.errors;
  const std::vector<const char*> files{"surface.vtp",          "surface.json",   "centreline.csv",
                                       "model/quality.json",   "model/flow.csv", "model/lumen.vtu",
                                       "model/centreline.csv", "model/case.yaml"};
  const std::string before = held(files);
  for (const char* fault :
       {"tether:write:lumen_faces.vtu:1:ENOSPC", "tether:write:surface.json:1:ENOSPC", "tether:write:5_ready:1:ENOSPC",
        "tether:write:case.yaml:1:ENOSPC", "tether:write:made_by.txt:1:ENOSPC"}) {
    const ChildEnd end = made("build-model", study(3), fault);
    EXPECT_EQ(end.exit_code, 1) << fault;
    EXPECT_NE(end.errors.find("; the surface and the model that were there are as they were\n"), std::string::npos)
        << end.errors;
    EXPECT_TRUE(held(files) == before) << fault;
    EXPECT_FALSE(fs::exists(folder_ / "out/.new_model")) << fault;
  }
  EXPECT_EQ(made("build-model", study(3), "tether:rename:lumen.vtu:1:KILL").exit_code, 128 + SIGKILL);
  EXPECT_FALSE(fs::exists(folder_ / "out/model/case.yaml")) << "of one surface, its meshes of another";
  EXPECT_EQ(made("build-model", study(3), "tether:rename:case.yaml:1:KILL").exit_code, 128 + SIGKILL);
  const ChildEnd again = made("build-model", study(3), no_fault);
  ASSERT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_FALSE(held(files) == before);
  EXPECT_FALSE(fs::exists(folder_ / "out/.new_model"));

  folder_.file("out/model/centreline.csv", "mine");
  const ChildEnd refused = made("build-model", study(4), no_fault);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.errors.find("model/centreline.csv: is not as tether build-model made it"), std::string::npos)
      << refused.errors;
}

TEST_F(UnwritableMade, ARingStays) {
  testing::write_stl(folder_ / "one.stl", testing::bent_tube());
  folder_.file("frames.csv", "file, time [s]\none.stl, 0\none.stl, 0.1\none.stl, 0.2\n");
  const fs::path ring =
      folder_.file("ring.yaml", "name: root\nframes: {file: frames.csv, unit: cm}\nring: {near: [4.2, 0, 0]}\n");
  const ChildEnd first = made("track-ring", ring, no_fault);
  ASSERT_EQ(first.exit_code, 0) << first.errors;
  const std::string before = held({"ring.json", "poses.csv"});
  EXPECT_FALSE(before.empty());
  EXPECT_EQ(made("track-ring", ring, "tether:write:poses.csv:1:ENOSPC").exit_code, 1);
  EXPECT_EQ(held({"ring.json", "poses.csv"}), before);
}

}  // namespace
}  // namespace tether
