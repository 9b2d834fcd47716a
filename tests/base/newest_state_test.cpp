#include "common/base/newest_state.hpp"

#include "common/base/checked_file.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// A run's state in a folder, as a master writes it.
void write_state(const fs::path& folder) {
  fs::create_directories(folder);
  const std::vector<std::byte> fluid(3, std::byte{1}), solid(5, std::byte{2});
  const std::uint64_t states = hash_of_states(fluid, solid);
  write_checked(folder / "fluid.bin", 77, 4, fluid);
  write_checked(folder / "solid.bin", 77, 4, solid);
  write_checked(folder / "master.bin", 77, 4, std::as_bytes(std::span(&states, 1)));
}

TEST(NewestState, OfARunIsThereInAnyOfThreePlaces) {
  const TemporaryFolder output;
  EXPECT_FALSE(has_state(output.path(), StateOf::run));
  for (const char* place : {newest_checkpoint, earlier_checkpoint, fresh_checkpoint}) {
    write_state(output / place);
    EXPECT_TRUE(has_state(output.path(), StateOf::run)) << place;
    EXPECT_FALSE(has_state(output.path(), StateOf::identification)) << place;
    remove_states(output.path());
    EXPECT_FALSE(has_state(output.path(), StateOf::run)) << place;
  }
  write_state(output / fresh_checkpoint);
  fs::remove(output / "checkpoint.new/solid.bin");
  EXPECT_FALSE(has_state(output.path(), StateOf::run)) << "killed while it was written";
}

TEST(NewestState, OfAnIdentificationIsThereInAnyOfThreePlaces) {
  const TemporaryFolder output;
  fs::create_directories(output / "checkpoint");
  for (const char* name : identification_state_files) {
    const fs::path file = output / "checkpoint" / name;
    write_checked(file, 77, 4, std::vector<std::byte>(9));
    EXPECT_TRUE(has_state(output.path(), StateOf::identification)) << name;
    EXPECT_FALSE(has_state(output.path(), StateOf::run)) << name;
    fs::remove(file);
  }
  output.file("checkpoint/identification.new", "cut short");
  EXPECT_FALSE(has_state(output.path(), StateOf::identification));
}

}  // namespace
}  // namespace tether
