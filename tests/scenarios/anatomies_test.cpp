/// The surfaces of configs/ that build-model makes models of, each to its first steps: whether it can is a matter of
/// rounding, and of what CGAL makes of it.
#include <gtest/gtest.h>

#include "common/base/child_process.hpp"
#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/io/record_file.hpp"
#include "tests/io/temporary_folder.hpp"
#include "vessel/model/model_quality.hpp"
#include "vessel/study/surface_summary.hpp"

namespace tether {
namespace anatomies_test {

namespace fs = std::filesystem;

ChildEnd told(std::vector<std::string> words) {
  words.insert(words.begin(), TETHER_PROGRAM);
  return capture({std::move(words), {}});
}

struct Anatomy {
  const char* name;
  std::size_t openings;
  double thinnest;  ///< of the wall that was asked: the study's least_share
};
void PrintTo(const Anatomy& anatomy, std::ostream* out) {
  *out << anatomy.name;
}
class Anatomies : public ::testing::TestWithParam<Anatomy> {};

TEST_P(Anatomies, BecomesAModelThatRuns) {
  const fs::path& here = test_folder();
  const auto& [name, openings, thinnest] = GetParam();
  const ChildEnd built = told({"build-model", fmt::format("{}/configs/{}/study.yaml", TETHER_SOURCE, name), "--output",
                               (here / name).string()});
  ASSERT_EQ(built.exit_code, exit_done) << built.errors << built.output;
  EXPECT_EQ(read_record<SurfaceSummary>(here / name / "surface.json").openings.size(), openings);
  EXPECT_GE(read_record<ModelQuality>(here / name / "model/quality.json").thickness.least_share, thinnest);
  const ChildEnd ran = told(
      {"simulate", (here / name / "model/case.yaml").string(), "--output", (here / "run").string(), "--steps", "3"});
  ASSERT_EQ(ran.exit_code, exit_done) << ran.errors << ran.output;
  const CsvTable series(here / "run/timeseries.csv", TableOf::tether);
  ASSERT_EQ(series.rows(), 3U);
  for (const double error : series.numbers("fluid.mass_balance_error")) EXPECT_LT(std::abs(error), 1e-9) << "cm3/s";
}

INSTANTIATE_TEST_SUITE_P(OfConfigs, Anatomies,
                         ::testing::Values(Anatomy{"aortic_arch", 5, 0.5}, Anatomy{"coarctation", 5, 0.5},
                                           Anatomy{"abdominal_aorta", 3, 0.5}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace anatomies_test
}  // namespace tether
