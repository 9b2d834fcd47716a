#include "diagnosis/comparison/other_discrepancy.hpp"

#include "common/base/csv.hpp"
#include "diagnosis/comparison/comparison.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

const MeasurementKind diameters{
    .name = "diameters", .meaning = "", .formats = "", .fallible = {}, .on_lumen = true, .section = nullptr};

/// Two diameters 0.1 and 0.3 cm larger than the run's, one held out 0.2 cm smaller, one that the run does not have.
class Diameters : public Measurement {
 public:
  MeasurementFacts facts() const override { return {diameters, "us", {0.05, 0, 0}, dimension::length}; }
  std::uint64_t content() const override { return 1; }
  std::vector<MeasuredPart> parts(const FinishedMotion&) const override { return {MeasuredPart{}}; }
  std::vector<Datum> data(const FinishedMotion&, const MeasuredPart&) const override {
    return {datum(0.1, false), datum(0.3, false), datum(-0.2, true), {.residual = 9, .is_seen = false}};
  }
  CountedRows rows(const Points&, double) const override { return {}; }
  std::vector<SeenRow> see(const ModelMoment&, double) const override { return {}; }

 private:
  static Datum datum(double residual, bool held_out) {
    Datum datum;
    datum.residual = residual;
    datum.held_out = held_out;
    return datum;
  }
};

Comparison compared() {
  Comparison comparison;
  comparison.others = {compare(Diameters(), FinishedMotion{}, UnitSystem::cgs())};
  return comparison;
}

TEST(OtherKinds, AreComparedNumberBesideNumber) {
  const OtherDiscrepancy found = compared().others.front();
  EXPECT_EQ(found.training.used, 2);
  EXPECT_NEAR(found.training.rms, std::sqrt(0.05), 1e-15);
  EXPECT_NEAR(found.training.bias, 0.2, 1e-15);
  EXPECT_NEAR(found.training.largest, 0.3, 1e-15);
  EXPECT_EQ(found.held_out.used, 1);
  EXPECT_NEAR(found.held_out.bias, -0.2, 1e-15);
}

TEST(OtherKinds, AreToldLikeAllMeasurements) {
  const std::vector<std::string> told = sentences_of(compared());
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0], "us (diameters): 0.224 cm off in root mean square over 2 values (4.5 times the noise)");
  EXPECT_EQ(told[1], "us, held out (diameters): 0.2 cm off in root mean square over 1 values (4.0 times the noise)");
  EXPECT_EQ(first_look_of(compared()), std::vector{told[0]});
}

TEST(OtherKinds, HaveRowsInTheTable) {
  const TemporaryFolder folder;
  write_blood_csv(folder / "blood.csv", compared());
  const CsvTable table(folder / "blood.csv");
  ASSERT_EQ(table.rows(), 2U);
  EXPECT_EQ(table.texts("kind")[1], "diameters");
  EXPECT_EQ(table.numbers("held_out")[1], 1);
  EXPECT_EQ(table.numbers("values")[0], 2);
  EXPECT_NEAR(table.numbers("bias")[1], -0.2, 1e-9);
  EXPECT_EQ(table.texts("l2_measured")[0], "");
}

}  // namespace
}  // namespace tether
