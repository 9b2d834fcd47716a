/// The service of runs behind `tether diagnose`: whoever dies, all of it ends, and the same command goes on from there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <csignal>
#include <future>
#include <nlohmann/json.hpp>

#include "common/base/child_process.hpp"
#include "tests/io/temporary_folder.hpp"
#include "tests/scenarios/case_variant.hpp"
#include "tests/scenarios/processes.hpp"

namespace tether {
namespace run_service_death_test {

namespace fs = std::filesystem;

constexpr const char* measured = R"(base: {}/configs/tube/case.yaml
name: model
time: {{step: 4e-3, end: 0.06}}
mesh: {{swept: {{around: 12, along: 8}}}}
diagnosis: {{candidates: [tissue_mass], exclude: [vicinity_left, vicinity_right, opposite], numerics: false}}
observations:
  traces:
    cuff: {{observable: fluid.outlet.pressure, quantity: pressure, absolute: false, noise: {{deviation: 5 mmHg}},
           curve: {{file: pressure.csv, value: pressure}}}}
)";

class RunService : public ::testing::Test {
 protected:
  RunService() { folder.file("pressure.csv", "time [s], pressure [mmHg]\n0, 0\n0.03, 1\n0.06, 2\n"); }
  ChildEnd diagnose() const { return capture({{TETHER_PROGRAM, "diagnose", given.string(), "--output", output}, {}}); }
  /// Kills a process of the diagnosis when its first run has ended, and returns how the diagnosis ends.
  ChildEnd killed(const std::string& program, const fs::path& case_file) const {
    auto end = std::async(std::launch::async, [this] { return diagnose(); });
    while (!fs::exists(first_run) && end.wait_for(std::chrono::milliseconds(5)) != std::future_status::ready) continue;
    const pid_t process = process_of(program, case_file);
    EXPECT_NE(process, 0) << program;
    if (process != 0) kill(process, SIGKILL);
    return end.get();
  }
  std::string orphan() const {
    return orphan_of({"mpirun", "identification_master", "fsi_master", "fluid", "solid"}, {candidates, coarse});
  }

  TemporaryFolder folder;
  const fs::path given = folder.file("case.yaml", fmt::format(measured, TETHER_SOURCE));
  const std::string output = (folder / "out").string();
  const fs::path candidates = folder / "out/candidates.yaml", coarse = folder / "out/coarse.yaml",
                 first_run = folder / "out/coarse/runs/base/run.json";
};

TEST_F(RunService, EndsWithTheDiagnosisThatIsKilled) {
  EXPECT_EQ(killed("tether", given).exit_code, 128 + SIGKILL);
  EXPECT_EQ(orphan(), "");
  const auto made = fs::last_write_time(first_run);
  const ChildEnd again = diagnose();
  EXPECT_EQ(again.exit_code, 0) << again.errors;
  EXPECT_EQ(fs::last_write_time(first_run), made) << "runs that are there are kept";
  EXPECT_EQ(orphan(), "");
}

TEST_F(RunService, ThatDiesEndsTheDiagnosisWithAMessage) {
  for (const char* program : {"identification_master", "fsi_master"}) {
    fs::remove_all(output);
    const ChildEnd end = killed(program, coarse);
    EXPECT_EQ(end.exit_code, 1) << program;
    EXPECT_NE(end.errors.find(program), std::string::npos) << end.errors;
    EXPECT_NE(end.errors.find("the same command goes on from there"), std::string::npos) << end.errors;
    EXPECT_EQ(orphan(), "");
  }
}

}  // namespace run_service_death_test
}  // namespace tether
