#pragma once

/// The front-end beside programs that are shell scripts.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "common/base/child_process.hpp"
#include "common/io/record_file.hpp"
#include "fsi_master/results/run_summary.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace front_end_test {

namespace fs = std::filesystem;

inline RunSummary summary_of_two_steps() {
  RunSummary s;
  s.steps = 2;
  s.wall_seconds = 1.25, s.seconds_per_step = 0.625;
  s.cpu_seconds["total"] = 2.5, s.loop_cpu_seconds["total"] = 2, s.cpu_seconds_per_step = 1,
  s.peak_memory_mb["total"] = 99.6;
  s.pressure.emplace();
  s.pressure->min_mmhg = 0.75, s.pressure->max_mmhg = 1.5;
  s.max_displacement_mm = 2;
  s.coupling_method = "iqn_ils";
  s.coupling_iterations = {2.5, 3};
  s.mass_balance_error_max = 1e-13;
  s.periodicity = Periodicity{0.1, 5e-3, {{2, 0.004, 0.0012}}, 2};
  s.units.flow = "cm3/s";
  return s;
}

inline constexpr const char* finished_run = R"sh(
case "$*" in
  *--describe-config*) echo "fluid.density [g/cm3]  (number)"; echo "    mass per volume"; exit 0;;
  *--validate*) exit 0;;
esac
echo "$@" >arguments
mkdir -p results
cat >results/timeseries.csv <<end
time [s],fluid.outlet.flow [cm3/s],fluid.outlet.pressure [g/(cm s2)],point.middle.displacement_length [cm],coupling.evaluations
0.1,1,1000,0.1,2
0.2,2,2000,0.2,3
end
cp summary_of_two_steps.json results/summary.json
(echo "# case_file: $PWD/case.yaml"; cat case.yaml) >results/case_as_run.yaml
)sh";

/// A folder with the front-end, a case, and the programs that a test makes up.
class FrontEnd : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::copy_file(TETHER_PROGRAM, folder_ / "tether");
    std::ofstream(folder_ / "case.yaml") << "name: tube\ntitle: A tube\nunits: cgs\ntime: {step: 0.1, end: 0.2}\n";
    write_record(folder_ / "summary_of_two_steps.json", summary_of_two_steps());
    for (const char* name : {"fluid", "solid", "fsi_master", "observation_manager", "identification_master"})
      program(name, finished_run);
  }
  void program(const std::string& name, const std::string& script) {
    std::ofstream(folder_ / name) << "#!/bin/sh\n" << script;
    fs::permissions(folder_ / name, fs::perms::owner_all);
  }
  ChildEnd tether(const std::string& arguments) {
    return capture({{"/bin/sh", "-c", "cd " + folder_.string() + " && ./tether " + arguments}, {}});
  }
  std::string content(const std::string& name) {
    std::ifstream file(folder_ / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  const TemporaryFolder own_;
  const fs::path folder_ = own_.path();
};

}  // namespace front_end_test
}  // namespace tether
