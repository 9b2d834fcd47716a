#include "common/config/curve_case.hpp"

#include "common/base/csv.hpp"
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
  auto stated = flow_from("time, flow [ml/s]\n0, 0\n100, 50\n");
  stated.time_unit = "ms";
  stated.value_unit = "cm3/s";
  stated.scale = 2.0;
  EXPECT_DOUBLE_EQ(stated.load(UnitSystem::cgs())(0.05), 50.0) << "the same unit by another name";
}

TEST(CurveCase, UnitsOfTheHeadingAndTheCaseAgree) {
  const auto error = [](const std::string& heading, const std::string& unit, const std::string& time_unit = "") {
    auto flow = flow_from(heading + "\n0, 1\n100, 1\n");
    flow.value_unit = unit;
    flow.time_unit = time_unit;
    return input_error_of([&] { flow.load(UnitSystem::si()); });
  };
  EXPECT_EQ(
      error("time, flow [l/min]", "ml/s"),
      "q.csv:2: column 'flow': is in l/min by its heading, in ml/s by the case: must be the same, or stated once");
  EXPECT_EQ(error("time [ms], flow", "ml/s", "s"),
            "q.csv:2: column 'time': is in ms by its heading, in s by the case: must be the same, or stated once");
  EXPECT_EQ(error("time, flow [L/min]", "l/min"), "no error");
  EXPECT_EQ(error("time, flow [cc/s]", "ml/s"),
            "q.csv:2: column 'flow': '1 cc/s': unknown unit 'cc/s'; this field is in m3/s");
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
  EXPECT_EQ(load_error("time, flow\n0,+5\n"), "no error");
  EXPECT_EQ(load_error("time, flow\n0,+-5\n"), "q.csv:2: flow: '+-5' is not a number");
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
  auto short_one = flow_from("time, flow\n0,1\n0.4,2\n0.8,3\n");
  short_one.period = 100.0;
  EXPECT_EQ(input_error_of([&] { short_one.load(UnitSystem::si()); }),
            "q.csv:4: the table tells 0.8 of a period of 100 and does not end as it begins");
  short_one.period = 7.9;
  EXPECT_NEAR(short_one.load(UnitSystem::si())(8.3), 2.0, 1e-12);
  auto pulse = flow_from("time, flow\n0,1\n0.4,2\n0.8,1\n");
  pulse.period = 100.0;
  EXPECT_EQ(pulse.load(UnitSystem::si())(50.0), 1.0) << "rests between its beats";
  periodic.file = "no.csv";
  EXPECT_EQ(input_error_of([&] { periodic.load(UnitSystem::si()); }), "no.csv: no such file");
  periodic.file = "/dev/zero";
  EXPECT_EQ(input_error_of([&] { periodic.load(UnitSystem::si()); }), "/dev/zero: is not a file");
  periodic.file = "/proc/version";  // as /proc/kmsg, which waits for what the kernel will say
  EXPECT_EQ(input_error_of([&] { periodic.load(UnitSystem::si()); }), "/proc/version: is not a file");
}

TEST(CurveCase, NumbersThatNothingHasAreRefused) {
  EXPECT_EQ(load_error("time [s], flow [ml/s]\n0,1\n0.1,-1e305\n"),
            "q.csv:3: flow: -1e305: must be from -1e+20 to 1e+20");
  EXPECT_EQ(load_error("time [s], flow [ml/s]\n0,1\n1e160,1\n"), "q.csv:3: time: 1e160: must be from -1e+20 to 1e+20");
  EXPECT_EQ(load_error("time [s], flow [ml/s]\n0,1e20\n"), "no error");
}

TEST(CurveCase, AColumnThatIsThereTwiceIsRefused) {
  EXPECT_EQ(load_error("time [s], flow [ml/s], flow [ml/s]\n0,1,1\n"),
            "q.csv:1: has two columns 'flow [ml/s]': leave one of them out");
  EXPECT_EQ(load_error("time [s], flow [ml/s], flow [l/min]\n0,10,300\n"),
            "q.csv: has two columns 'flow' of different values: leave one of them out");
  EXPECT_EQ(load_error("time [s], flow [ml/s], flow [l/min]\n0,10,0.6\n"), "no error")
      << "as a run's timeseries.csv has them";
  const auto table = write_file("q.csv", "time [s], a [deg], a [rad]\n0,1,1e30\n");
  EXPECT_EQ(input_error_of([&] { CsvTable(table).numbers("a"); }), "q.csv: has two columns 'a': leave one of them out");
  EXPECT_EQ(CsvTable(table, TableOf::tether).numbers("a"), std::vector{1.0});
}

TEST(CurveCase, QuotationMarksStandAroundACell) {
  EXPECT_EQ(load_error("\"time [s]\", \"flow [ml/s]\"\n \"0\" , 1\r\n"), "no error");
  constexpr const char* rule =
      " has a quotation mark that does not stand around it: must have none, or one at each end and no comma between";
  for (const char* cells : {"0, \"1", "0, 1\"", "0, 1\"2", "0, \"\"1\"\"", "0, \""})
    EXPECT_EQ(load_error(std::string("time [s], flow [ml/s]\n0, 1\n") + cells + "\n"),
              std::string("q.csv:3: cell 2") + rule)
        << cells;
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
  EXPECT_EQ(errors_in("fluid: {file: q.csv, scale: 1e15}\n", CurveCase(dimension::flow)),
            "case.yaml:6: fluid.scale: 1e15: must be at least -1e12 and at most 1e12");
}

}  // namespace
}  // namespace tether
