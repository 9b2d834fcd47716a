#include "common/config/curve_case.hpp"

#include "tests/config/case_text.hpp"

namespace tether {
namespace {

CurveCase flow_from(const std::string& csv) {
  CurveCase flow(dimension::flow);
  flow.file = write_file("q.csv", csv);
  flow.value = "flow";
  return flow;
}

std::string load_error(const std::string& csv) {
  const auto flow = flow_from(csv);
  return input_error_of([&] { flow.load(UnitSystem::si()); });
}

TEST(CurveCase, ConvertsToTheUnitsOfTheCase) {
  const Curve headed = flow_from("time [ms], flow [ml/s]\n0, 0\n100, 50\n").load(UnitSystem::si());
  EXPECT_DOUBLE_EQ(headed(0.1), 50e-6);
  auto stated = flow_from("time, flow [l/min]\n0, 0\n100, 50\n");
  stated.time_unit = "ms";
  stated.value_unit = "ml/s";
  stated.scale = 2.0;
  EXPECT_DOUBLE_EQ(stated.load(UnitSystem::cgs())(0.05), 50.0) << "the case file overrides the heading";
}

TEST(CurveCase, ReadsFromACase) {
  write_file("q.csv", "t_s,flow\n0,1\n0.5,3\n");
  const auto path = write_file(
      "case.yaml", valid_head + "fluid: {file: q.csv, time: t_s, value: flow, value_unit: ml/s, period: 1}\n");
  CaseFile file(path);
  CurveCase flow(dimension::flow);
  file.read("fluid", flow);
  file.finish();
  const Curve curve = flow.load(file.units());
  EXPECT_DOUBLE_EQ(curve(0.25), 2.0);
  EXPECT_DOUBLE_EQ(curve(7.75), 2.0) << "periodic, back from 3 to 1";
  EXPECT_EQ(errors_in("fluid: {}\n", CurveCase(dimension::flow)),
            "case.yaml:6: fluid.file: give either a file or a constant");
}

TEST(CurveCase, NamesWhatIsWrongWithTheTable) {
  EXPECT_EQ(load_error("time, flux\n0,1\n"), "q.csv: has no column 'flow'; its columns are time, flux");
  EXPECT_EQ(load_error("time, flow\n0,1\n0.1,x\n"), "q.csv:3: flow: 'x' is not a number");
  EXPECT_EQ(load_error("time, flow\n0,nan\n"), "q.csv:2: flow: 'nan' is not a number");
  EXPECT_EQ(load_error("time, flow\n\n0,\n"), "q.csv:3: flow: '' is not a number");
  EXPECT_EQ(load_error("# measured\ntime, flow\n0,1\n0.2,1\n0.2,3\n"), "q.csv:5: the time 0.2 does not come after 0.2");
  EXPECT_EQ(load_error("time, flow\n0,1,2\n"),
            "q.csv:2: cells in this row: 3, columns: 2 (numbers have points, not commas: 0.5)");
  EXPECT_EQ(load_error("time, flow\n"), "q.csv: has no rows");
  EXPECT_EQ(load_error("\xEF\xBB\xBFtime, flow\n0,x\n"), "q.csv:2: flow: 'x' is not a number") << "a byte order mark";
  EXPECT_EQ(load_error("time; flow\n0,5; 1\n"),
            "q.csv:1: columns are separated by semicolons: must be commas, and numbers have points (0.5)");
  EXPECT_EQ(load_error("time\tflow\n0\t1\n"),
            "q.csv:1: columns are separated by tabulators: must be commas, and numbers have points (0.5)");
  EXPECT_EQ(load_error("time, flow [mmHg]\n0,1\n"),
            "q.csv:2: column 'flow': '1 mmHg': mmHg is no unit of this field, which is in m3/s");
  auto periodic = flow_from("time, flow\n0,1\n1.1,1\n");
  periodic.period = 1.0;
  EXPECT_EQ(input_error_of([&] { periodic.load(UnitSystem::si()); }),
            "q.csv:3: the time 1.1 lies beyond one period of 1");
  periodic.file = "no.csv";
  EXPECT_EQ(input_error_of([&] { periodic.load(UnitSystem::si()); }), "no.csv: no such file");
  periodic.file = "/dev/zero";
  EXPECT_EQ(input_error_of([&] { periodic.load(UnitSystem::si()); }), "/dev/zero: is not a file");
}

TEST(Curve, HoldsItsEndsAndRises) {
  const Curve held({1.0, 2.0}, {3.0, 5.0});
  EXPECT_EQ(held(0.0), 3.0);
  EXPECT_EQ(held(1.5), 4.0);
  EXPECT_EQ(held(9.0), 5.0);
  const Curve ramped = Curve::constant(4.0, 2.0);
  EXPECT_EQ(ramped(0.0), 0.0);
  EXPECT_NEAR(ramped(1.0), 2.0, 1e-15);
  EXPECT_EQ(ramped(2.0), 4.0);
}

TEST(Curve, PeriodMayBeGivenByTheLastRow) {
  const Curve closed({0.0, 0.5, 1.0}, {1.0, 2.0, 1.5}, {1.0, 0.0, 1.0});
  EXPECT_DOUBLE_EQ(closed(0.75), 1.75);
  EXPECT_DOUBLE_EQ(closed(1.25), 1.5);
  EXPECT_DOUBLE_EQ(closed(-0.25), 1.75);
}

TEST(Curve, ScaleIsNoLargerThanAnyChangeOfUnits) {
  write_file("q.csv", "time, value\n0,1\n1,1\n");
  EXPECT_EQ(errors_in("fluid: {file: q.csv, scale: 1e300}\n", CurveCase(dimension::flow)),
            "case.yaml:6: fluid.scale: 1e300: must be at least -1e12 and at most 1e12");
}

}  // namespace
}  // namespace tether
