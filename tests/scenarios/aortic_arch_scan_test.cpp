/// configs/aortic_arch_scan: the commands of its README, from voxels to the first steps of a beat.
#include <gtest/gtest.h>

#include <fstream>

#include "common/base/child_process.hpp"
#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/io/record_file.hpp"
#include "tests/io/temporary_folder.hpp"
#include "vessel/study/surface_summary.hpp"

namespace tether {
namespace aortic_arch_scan_test {

namespace fs = std::filesystem;

ChildEnd told(std::vector<std::string> words) {
  words.insert(words.begin(), TETHER_PROGRAM);
  return capture({std::move(words), {}});
}

TEST(AorticArchScan, RunsFromItsVoxels) {
  const fs::path& here = test_folder();
  const fs::path model = here / "model";
  const ChildEnd built =
      told({"build-model", TETHER_SOURCE "/configs/aortic_arch_scan/study.yaml", "--output", model.string()});
  ASSERT_EQ(built.exit_code, exit_done) << built.errors << built.output;
  const auto summary = read_record<SurfaceSummary>(model / "surface.json");
  ASSERT_TRUE(summary.image);
  EXPECT_EQ(summary.image->method, ImageMethod::level_set);
  EXPECT_EQ(summary.branches.size(), 3U);
  for (const BuiltOpening& opening : summary.openings)
    EXPECT_EQ(opening.at_image_border, opening.name != "ascending") << opening.name;
  EXPECT_NEAR(summary.openings[0].radius, 1.533, 0.05) << "cm; of data/aortic_arch_adult/regions.csv";
  EXPECT_NEAR(summary.openings[2].radius, 0.529, 0.075)
      << "cm; the left subclavian, 7 voxels wide: half a voxel (edges of 4 mm across it lose most of that)";
  for (const char* file : {"1_slices.png", "1_read.vtp", "surface.vtp", "model/case.yaml"})
    EXPECT_TRUE(fs::exists(model / file)) << file;

  const ChildEnd ran =
      told({"simulate", (model / "model/case.yaml").string(), "--output", (here / "run").string(), "--steps", "5"});
  ASSERT_EQ(ran.exit_code, exit_done) << ran.errors << ran.output;
  const CsvTable series(here / "run/timeseries.csv", TableOf::tether);
  ASSERT_EQ(series.rows(), 5U);
  for (const double error : series.numbers("fluid.mass_balance_error")) EXPECT_LT(std::abs(error), 1e-9) << "cm3/s";
  for (const double jacobian : series.numbers("fluid.smallest_jacobian")) EXPECT_GT(jacobian, 0.5);
}

}  // namespace aortic_arch_scan_test
}  // namespace tether
