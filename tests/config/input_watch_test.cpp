#include "common/config/input_watch.hpp"

#include "tests/config/case_text.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

class WatchedInputs : public ::testing::Test {
 protected:
  WatchedInputs() {
    fs::create_directories(test_folder() / "mesh/surfaces");
    write_file("base.yaml", "name: base\nfluid: {flow: flow.csv}\nmesh: {fluid: mesh}\n");
    write_file("case.yaml", "base: base.yaml\nobservations: {surfaces: {file: list.csv}}\n");
    for (const char* name : {"flow.csv", "1.vtp", "mesh/surfaces/wall.vtp", "mesh/notes.txt", "other.csv"})
      write_file(name, "some text\n");
    write_file("list.csv", "file, time [s]\n1.vtp, 0\n");
  }
  /// The file that a watch made before names; empty if none.
  static std::string changed(const std::function<void()>& write) {
    const InputWatch watch(test_folder() / "case.yaml");
    watch.check();
    write();
    try {
      watch.check();
    } catch (const RunError& error) {
      return fs::path(std::string(error.what()).substr(0, std::string(error.what()).find(": was written")))
          .lexically_relative(test_folder())
          .string();
    }
    return "";
  }
};

TEST_F(WatchedInputs, AreThoseOfTheCaseOfItsBaseAndOfItsTables) {
  for (const char* name : {"case.yaml", "base.yaml", "flow.csv", "list.csv", "1.vtp", "mesh/surfaces/wall.vtp"})
    EXPECT_EQ(changed([&] { std::ofstream(test_folder() / name, std::ios::app) << "\n"; }), name);
  for (const char* name : {"other.csv", "mesh/notes.txt", "new.csv"})
    EXPECT_EQ(changed([&] { std::ofstream(test_folder() / name, std::ios::app) << "\n"; }), "") << name;
  EXPECT_EQ(changed([&] { fs::remove(test_folder() / "1.vtp"); }), "1.vtp");
}

TEST_F(WatchedInputs, WereWrittenAlsoIfTheyHoldTheSameAgain) {
  const fs::path flow = test_folder() / "flow.csv";
  const auto time = fs::last_write_time(flow);
  const auto swap = [&] {
    write_file("flow.csv", "other txt\n");
    write_file("flow.csv", "some text\n");
    fs::last_write_time(flow, time);
  };
  EXPECT_EQ(changed(swap), "flow.csv");
  EXPECT_EQ(changed([&] {
              fs::copy_file(flow, test_folder() / "kept.csv", fs::copy_options::overwrite_existing);
              fs::rename(test_folder() / "kept.csv", flow);
            }),
            "flow.csv");
}

}  // namespace
}  // namespace tether
