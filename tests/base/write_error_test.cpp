#include "common/base/write_error.hpp"

#include <gtest/gtest.h>

#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

TEST(FoldersBelow, AreMadeInOneThatIsThere) {
  const TemporaryFolder folder;
  make_folders_below(folder.path(), folder / "runs/a/b");
  EXPECT_TRUE(fs::is_directory(folder / "runs/a/b"));
  make_folders_below(folder.path(), folder / "runs/a/b");
  make_folders_below(folder.path(), folder.path());
  EXPECT_TRUE(fs::is_directory(folder / "runs/a/b"));
}

TEST(FoldersBelow, DoNotMakeOneAnewThatWasRemoved) {
  const TemporaryFolder folder;
  for (const std::string of : {"case/runs/a", "case"}) {
    const fs::path wanted = folder / of;
    EXPECT_EQ(message_of([&] { make_folders_below(folder / "case", wanted); }),
              (folder / "case" / (of == "case" ? "." : "runs")).string() + ": cannot be written: its folder is gone");
    EXPECT_FALSE(fs::exists(folder / "case"));
  }
}

TEST(FoldersBelow, AreMadeElsewhereToo) {
  const TemporaryFolder folder;
  make_folders_below(folder / "case", folder / "elsewhere/a");
  EXPECT_TRUE(fs::is_directory(folder / "elsewhere/a"));
  make_folders_below(folder / "case", folder / "case_of_another/a");  // a name that begins alike is another folder
  EXPECT_TRUE(fs::is_directory(folder / "case_of_another/a"));
}

}  // namespace
}  // namespace tether
