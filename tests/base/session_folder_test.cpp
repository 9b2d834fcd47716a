#include "common/base/session_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>

namespace tether {
namespace {

namespace fs = std::filesystem;

TEST(SessionFolder, TakesAwayWhatKilledProcessesLeft) {
  const std::string name = "tether_session_of_test_" + std::to_string(getpid());
  const auto now = fs::file_time_type::clock::now(), hours_ago = now - std::chrono::hours(2);
  const fs::path left = temporary_folder() / (name + "_left"), young = temporary_folder() / (name + "_young"),
                 other = temporary_folder() / ("tether_other_session_" + std::to_string(getpid()));
  for (const fs::path& folder : {left, young, other}) fs::create_directories(folder / "files");
  const SessionFolder held(name);
  for (const fs::path& folder : {left, other, held.path()}) fs::last_write_time(folder, hours_ago);
  fs::last_write_time(young, now);
  fs::path second;
  {
    const SessionFolder session(name);
    second = session.path();
    EXPECT_TRUE(fs::is_directory(second));
  }
  EXPECT_FALSE(fs::exists(second));
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(young)) << "its process may not have locked it yet";
  EXPECT_TRUE(fs::exists(other));
  EXPECT_TRUE(fs::exists(held.path())) << "its process lives";
  fs::remove_all(young);
  fs::remove_all(other);
}

}  // namespace
}  // namespace tether
