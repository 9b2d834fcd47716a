/// Verbs that make something of a file that is no case: a folder of somebody else's files is left as it is.
#include <gtest/gtest.h>

#include <algorithm>

#include "common/base/child_process.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/case_variant.hpp"

namespace tether {
namespace made_folders_test {

namespace fs = std::filesystem;

struct Made {
  const char *verb, *file;
  std::vector<const char*> own;  ///< files of the user's, called as what the verb makes
};

void PrintTo(const Made& one, std::ostream* out) {
  *out << one.verb;
}

class MadeFolderOf : public ::testing::TestWithParam<Made> {
 protected:
  MadeFolderOf() {
    folder_.file("frames.csv", "file, time [s]\nframe.stl, 0\nframe.stl, 1\n");
    folder_.file("ring.yaml", "name: root\nframes: {file: frames.csv, unit: mm}\n");
    for (const char* name : GetParam().own) {
      fs::create_directories((folder_ / "mine" / name).parent_path());
      folder_.file(fs::path("mine") / name, name);
    }
  }
  fs::path input() const {
    const fs::path own = folder_ / GetParam().file;
    return fs::exists(own) ? own : fs::path(TETHER_SOURCE) / GetParam().file;
  }

  TemporaryFolder folder_;
};

TEST_P(MadeFolderOf, IsNoFolderOfOtherFiles) {
  const ChildEnd end = capture({{TETHER_PROGRAM, GetParam().verb, input().string(), "--output", folder_ / "mine"}, {}});
  EXPECT_EQ(end.exit_code, 2) << end.errors;
  EXPECT_NE(end.errors.find((folder_ / "mine").string()), std::string::npos) << end.errors;
  EXPECT_NE(end.errors.find("--overwrite"), std::string::npos) << end.errors;
  for (const char* name : GetParam().own) EXPECT_EQ(content_of(folder_ / "mine" / name), name);
}

INSTANTIATE_TEST_SUITE_P(All, MadeFolderOf,
                         testing::Values(Made{"build-model", "configs/aortic_arch/study.yaml", {"case.yaml", "a.txt"}},
                                         Made{"fit-outlets", "configs/descending_aorta/outlets.yaml", {"outlets.yaml"}},
                                         Made{"track-ring", "ring.yaml", {"ring.json", "plots/ring.png"}},
                                         Made{"twin", "configs/hidden_effect/case.yaml", {"case.yaml", "data/a.csv"}}),
                         [](const auto& tested) {
                           std::string name = tested.param.verb;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace made_folders_test
}  // namespace tether
