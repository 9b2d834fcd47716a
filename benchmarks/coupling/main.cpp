#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "common/base/process.hpp"
#include "fsi_master/statistics.hpp"
#include "tests/scenarios/case_variant.hpp"
#include "tests/scenarios/coupled_vessel.hpp"

/// What each way of coupling takes for the steps of a case: a table of evaluations, Krylov iterations and processor
/// time.
///   coupling_benchmark CASE.yaml [STEPS] [ "PIECE OF THE CASE" "ITS REPLACEMENT" ]...
namespace tether {
namespace {

namespace fs = std::filesystem;

struct Way {
  const char *method, *section;
};

constexpr Way ways[] = {{"newton_krylov", "method: newton_krylov"},
                        {"iqn_ils, reuse 0", "method: iqn_ils, reuse: 0"},
                        {"iqn_ils, reuse 5", "method: iqn_ils, reuse: 5"},
                        {"iqn_ils, reuse 10", "method: iqn_ils, reuse: 10"},
                        {"iqn_ils, reuse 20", "method: iqn_ils, reuse: 20"}};

void measure(const Way& way, const fs::path& case_file, int steps) {
  CoupledVessel vessel(case_file);
  if (steps == 0) steps = vessel.steps_of_case();
  MeanMax evaluations, krylov;
  const double begun = cpu_seconds();
  for (int n = 0; n < steps; ++n) {
    const StepRecord& step = vessel.advance();
    evaluations.add(step.evaluations);
    krylov.add(step.krylov_iterations);
  }
  std::printf("| %s | %.2f | %.0f | %.1f | %.0f | %.1f |\n", way.method, evaluations.mean(), evaluations.max,
              krylov.mean(), krylov.max, 1e3 * (cpu_seconds() - begun) / steps);
  std::fflush(stdout);
}

int run(int argc, char** argv) {
  const fs::path original = argv[1], folder = fs::temp_directory_path() / "tether_coupling_benchmark";
  const int steps = argc > 2 ? std::atoi(argv[2]) : 0;
  std::printf(
      "| method | evaluations | at most | Krylov iterations | at most | ms a step |\n|---|---|---|---|---|---|\n");
  for (const Way& way : ways) {
    Edits edits{{"coupling: {", std::string("coupling: {") + way.section + ", "}};
    for (int i = 3; i + 1 < argc; i += 2) edits.push_back({argv[i], argv[i + 1]});
    measure(way, case_variant(original, folder, edits), steps);
  }
  fs::remove_all(folder);
  return 0;
}

}  // namespace
}  // namespace tether

int main(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "usage: coupling_benchmark CASE.yaml [STEPS] [OLD NEW]...\n"), 2;
  return tether::run(argc, argv);
}
