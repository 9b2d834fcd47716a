#include "common/config/changed_case.hpp"

#include <chrono>

#include "common/config/output_folder.hpp"
#include "tests/config/case_text.hpp"

namespace tether {
namespace changed_case_test {

namespace fs = std::filesystem;

/// Results of a case that builds on another and names a file.
class ChangedCase : public ::testing::Test {
 protected:
  void SetUp() override {
    write_file("flow.csv", "t\n");
    write_file("base.yaml", "name: tube\nunits: cgs\ntime: {step: 1e-3, end: 1}\n");
    write("title: As it was\ntime: {end: 2}\nfluid: {curve: flow.csv, density: 1.06, angles: [1, 2]}\n");
    fs::create_directories(results());
    mark_output(results(), file());
    touch(results() / case_as_run, 0);
  }
  void write(const std::string& rest) const { write_file("case.yaml", "base: base.yaml\n" + rest); }
  static void touch(const fs::path& path, int seconds) {
    static const fs::file_time_type begun = fs::file_time_type::clock::now();
    fs::last_write_time(path, begun + std::chrono::seconds(seconds));
  }
  fs::path file() const { return test_folder() / "case.yaml"; }
  fs::path results() const { return test_folder() / "results"; }
  std::string told() const { return told_changes(results(), file()); }
};

TEST_F(ChangedCase, TellsEachValue) {
  write("title: As it is\ntime: {step: 2e-3, end: 2}\nfluid: {curve: flow.csv, angles: [1, 3], viscosity: 4}\n");
  EXPECT_EQ(told(),
            "fluid.angles: [1, 3] now, [1, 2] before; fluid.density: none now, 1.06 before; "
            "fluid.viscosity: 4 now, none before; time.step: 2e-3 now, 1e-3 before");
}

TEST_F(ChangedCase, TellsNoMoreThanAMessageHolds) {
  write("fluid: {a: 1, b: 2, c: 3, d: 4}\n");
  EXPECT_NE(told().find("; and 3 more"), std::string::npos) << told();
}

TEST_F(ChangedCase, TellsWhichFileWasWrittenSince) {
  touch(test_folder() / "flow.csv", -10);
  touch(file(), 10);
  EXPECT_EQ(told(), "") << "the case says what it said";
  touch(test_folder() / "flow.csv", 10);
  EXPECT_EQ(told(), (test_folder() / "flow.csv").string() + ": written since");
}

TEST_F(ChangedCase, TellsNothingOfResultsThatDoNotSayWhatTheyAreOf) {
  write("fluid: {a: 1}\n");
  std::ofstream(results() / case_as_run) << "{";
  EXPECT_EQ(told(), "");
  fs::remove(results() / case_as_run);
  EXPECT_EQ(told(), "");
}

}  // namespace changed_case_test
}  // namespace tether
