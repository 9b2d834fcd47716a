/// Scripts for gnuplot: run where they stand, whatever the way to that place looks like.
#include "pictures/gnuplot.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

class Gnuplot : public ::testing::Test {
 protected:
  /// A folder with a script of the same name that must not run.
  void add_foreign(const std::string& name) const {
    fs::create_directories(folder_ / name / "plots");
    folder_.file(name + "/plots/a.gp", "system 'touch " + owned().string() + "'\n");
  }
  fs::path owned() const { return folder_ / "owned"; }

  TemporaryFolder folder_;
  const std::string script_ = gnuplot_head(200, 100) + "set output 'plots/a.png'\nplot x\n";
};

TEST_F(Gnuplot, RunsWhereAWayThroughALinkLeads) {
  add_foreign("results");
  fs::create_directories(folder_ / "deep/er");
  fs::create_directory_symlink("deep/er", folder_ / "link");
  run_gnuplot(folder_ / "link/../results", "a.gp", script_);
  EXPECT_TRUE(fs::exists(folder_ / "deep/results/plots/a.png"));
  EXPECT_FALSE(fs::exists(owned()));
}

/// A shell's cd looks for a relative folder there first.
TEST_F(Gnuplot, RunsWhereItIsAskedToWhateverCdpathSays) {
  add_foreign("elsewhere/results");
  const fs::path before = fs::current_path();
  fs::current_path(folder_.path());
  ASSERT_EQ(setenv("CDPATH", (folder_ / "elsewhere").c_str(), 1), 0);
  run_gnuplot("results", "a.gp", script_);
  unsetenv("CDPATH");
  fs::current_path(before);
  EXPECT_TRUE(fs::exists(folder_ / "results/plots/a.png"));
  EXPECT_FALSE(fs::exists(owned()));
}

TEST_F(Gnuplot, LeavesNoPictureOfBeforeWhereItFails) {
  run_gnuplot(folder_ / "results", "a.gp", script_);
  EXPECT_THROW(run_gnuplot(folder_ / "results", "a.gp", "exit status 3\nset output 'plots/a.png'\n"), std::exception);
  EXPECT_FALSE(fs::exists(folder_ / "results/plots/a.png"));
}

}  // namespace
}  // namespace tether
