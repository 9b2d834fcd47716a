#include "diagnosis/evidence/coarse_runs.hpp"

#include <gtest/gtest.h>

#include "common/config/overlay.hpp"
#include "tests/config/case_text.hpp"

namespace tether {
namespace {

class CoarseCase : public ::testing::Test {
 protected:
  CoarseCase() { write_file("pressure.csv", "time [s],value [mmHg]\n0,80\n0.4,120\n0.8,80\n"); }
  /// What the coarser case says otherwise, by field.
  std::map<std::string, double> of(const std::string& time, const std::string& more = "") const {
    const auto path =
        write_file("case.yaml", "name: tube\nunits: cgs\ntime: " + time +
                                    "\nmesh: {source: swept, swept: {radius: 1, length: 4, wall_thickness: 0.2, "
                                    "around: 32, along: 20, regions: "
                                    "{wall: {}}}}\nobservations: {traces: {cuff: {observable: fluid.outlet.pressure, "
                                    "quantity: pressure, curve: "
                                    "{file: pressure.csv}, noise: {deviation: 1 mmHg, correlation_time: 0.02}}}}\n" +
                                    more);
    const auto candidates = write_file("candidates.yaml", "base: case.yaml\nname: tube_candidates\n");
    std::map<std::string, double> values;
    for (const Overlay::Value& value : values_of_overlay(write_coarse(candidates, DiagnosedCase(path))))
      values[value.field] = std::stod(value.text);
    return values;
  }
};

TEST_F(CoarseCase, HasTwiceTheStepAndHalfTheElements) {
  const auto values = of("{step: 2e-3, end: 0.8}");
  EXPECT_DOUBLE_EQ(values.at("time.step"), 4e-3);
  EXPECT_EQ(values.at("mesh.swept.around"), 16);
  EXPECT_EQ(values.at("mesh.swept.along"), 10);
  EXPECT_FALSE(values.contains("time.end"));
}

TEST_F(CoarseCase, IsCoupledLessExactlyUnlessTheModelIs) {
  const std::string time = "{step: 2e-3, end: 0.8}";
  EXPECT_DOUBLE_EQ(of(time).at("coupling.tolerance"), 1e-4);
  EXPECT_DOUBLE_EQ(of(time, "coupling: {tolerance: 1e-6}\n").at("coupling.tolerance"), 1e-4);
  EXPECT_FALSE(of(time, "coupling: {tolerance: 1e-3}\n").contains("coupling.tolerance"));
}

/// 207 steps of 4 ms end at 0.828 s, and a frame may lie there.
TEST_F(CoarseCase, EndsWhereTheModelsLastStepDoes) {
  const auto values = of("{step: 4e-3, end: 0.825}");
  EXPECT_DOUBLE_EQ(values.at("time.end"), 0.828);
  EXPECT_NEAR(std::remainder(0.828, values.at("time.step")), 0, 1e-12);
  EXPECT_LE(values.at("time.step"), 8e-3);
}

/// Of those that are coarsened the direction which is least counts; where none is, the step's.
TEST(CoarseMesh, IsCoarserByWhatItsLeastDirectionIs) {
  const auto mesh = [](int around, int along) {
    MeshCase made;
    made.source = "swept";
    made.swept.around = around;
    made.swept.along = along;
    return made;
  };
  EXPECT_DOUBLE_EQ(coarser_by(mesh(32, 20)), 2);
  EXPECT_DOUBLE_EQ(coarser_by(mesh(16, 12)), 16.0 / 12);
  EXPECT_DOUBLE_EQ(coarser_by(mesh(12, 16)), 2) << "around there are as few as may be";
  EXPECT_DOUBLE_EQ(coarser_by(mesh(12, 8)), 2) << "the step's";
  EXPECT_DOUBLE_EQ(coarser_by(mesh(24, 9)), 2) << "along it stays: 8 would hardly be fewer";
  EXPECT_DOUBLE_EQ(coarser_by(mesh(14, 7)), 2);
  EXPECT_TRUE(has_coarser_mesh(mesh(16, 12)));
  EXPECT_FALSE(has_coarser_mesh(mesh(12, 16))) << "what twelve around do wrong it does not tell";
  EXPECT_FALSE(has_coarser_mesh(mesh(24, 9)));
  EXPECT_FALSE(has_coarser_mesh(mesh(12, 8)));
  MeshCase read = mesh(32, 20);
  read.source = "files";
  EXPECT_FALSE(has_coarser_mesh(read));
  EXPECT_DOUBLE_EQ(coarser_by(read), 2);
}

}  // namespace
}  // namespace tether
