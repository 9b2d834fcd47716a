/// `tether simulate` whose files cannot be written, from some call on: one message that names the file and the cause,
/// and the same command with --resume leaves what an undisturbed run leaves. The whole table: benchmarks/reliability.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "common/base/child_process.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/case_variant.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// A library before all others but those that are there already (a sanitizer's tests have one).
std::string preloaded(const std::string& library) {
  const char* before = std::getenv("LD_PRELOAD");
  return before == nullptr ? library : library + ":" + before;
}

struct Unwritable {
  const char *name, *fault, *message;
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
  const ChildEnd end = simulate("out", "--overwrite",
                                {{"LD_PRELOAD", preloaded(TETHER_FAULTS)},
                                 {"TETHER_FAULT_ROOT", output.string()},
                                 {"TETHER_FAULT", GetParam().fault}});
  EXPECT_EQ(end.exit_code, 1);
  EXPECT_NE(end.errors.find(GetParam().message), std::string::npos) << end.errors;
  EXPECT_LE(std::count(end.errors.begin(), end.errors.end(), '\n'), 3) << end.errors;

  const bool is_saved = fs::exists(output / "checkpoint");
  const ChildEnd again = simulate("out", is_saved ? "--resume" : "--overwrite", {});
  ASSERT_EQ(again.exit_code, 0) << again.errors;
  ASSERT_EQ(simulate("whole", "--overwrite", {}).exit_code, 0);
  for (const char* name : {"timeseries.csv", "lumen.motion", "fluid.pvd", "vtk/solid_000012.vtu"})
    EXPECT_EQ(content_of(folder_ / "whole" / name), content_of(output / name)) << name;
}

INSTANTIATE_TEST_SUITE_P(
    Some, UnwritableFile,
    ::testing::Values(Unwritable{"Motion", "fsi_master:write:lumen.motion:7:ENOSPC",
                                 "lumen.motion: cannot be written: no space is left on its disk"},
                      Unwritable{"Checkpoint", "fsi_master:write:checkpoint.new/fluid.bin:2:EDQUOT",
                                 "checkpoint.new/fluid.bin: cannot be written: Disk quota exceeded"},
                      Unwritable{"Renaming", "fsi_master:rename:checkpoint:1:EIO", "Input/output error"},
                      Unwritable{"OfAPartner", "solid:write:vtk/solid:4:ENOSPC", "vtk/solid"},
                      Unwritable{"Summary", "fsi_master:open:summary.json:1:EACCES",
                                 "summary.json: cannot be written: Permission denied"}),
    [](const auto& info) { return std::string(info.param.name); });

/// A twin that is there stays whole until the next one is.
TEST(UnwritableTwin, LeavesTheOneThatIsThere) {
  const TemporaryFolder folder;
  folder.file("model.yaml", fmt::format("base: {}/configs/tube/case.yaml\nname: model\n"
                                        "time: {{step: 4e-3, end: 0.04}}\nmesh: {{swept: {{around: 12, along: 8}}}}\n",
                                        TETHER_SOURCE));
  folder.file("same.yaml", "base: model.yaml\nname: same\n");
  const auto twin = [&](int frames, const std::string& fault) {
    const fs::path file =
        folder.file("twin.yaml", fmt::format("base: model.yaml\nname: twin\ntwin: {{truth: same.yaml, "
                                             "frames: {}, image: {{voxel: [0, 0, 0]}}, hidden: "
                                             "{{verdict: nothing_missing}}}}\n",
                                             frames));
    return capture({{TETHER_PROGRAM, "twin", file.string(), "--output", (folder / "out").string(), "--quiet"},
                    {{"LD_PRELOAD", preloaded(TETHER_FAULTS)},
                     {"TETHER_FAULT_ROOT", (folder / "out").string()},
                     {"TETHER_FAULT", fault}}});
  };
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
}

}  // namespace
}  // namespace tether
