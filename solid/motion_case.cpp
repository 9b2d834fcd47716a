#include "solid/motion_case.hpp"

#include "common/base/csv.hpp"
#include "common/base/curve.hpp"
#include "common/config/columns.hpp"

namespace tether {

void MotionCase::declare(Fields& f) {
  f.path("file", file, "CSV file with the ring's displacement over time", Need::required);
  f.text("time", time, "column of the time");
  f.text("x", x, "column of the displacement along x");
  f.text("y", y, "column of the displacement along y");
  f.text("z", z, "column of the displacement along z");
  f.number("period", period, dimension::time, range::positive,
           "duration after which the motion repeats; absent: it does not");
  for (const auto& [field, column] : {std::pair{"time", time}, {"x", x}, {"y", y}, {"z", z}})
    check_column(f, field, column, file);
}

TissueMotion MotionCase::load(const UnitSystem& units) const {
  const CsvTable table(file);
  const auto column = [&](const std::string& name, Dimension dimension) {
    std::vector<double> values = table.numbers(name);
    const std::string unit = table.unit(name);
    if (!unit.empty())
      for (double& value : values) value *= units.quantity("1 " + unit, dimension);
    return values;
  };
  const CurveShape shape{.period = period.value_or(0.0)};
  const auto curve = [&](const std::string& name) {
    return Curve(column(time, dimension::time), column(name, dimension::length), shape);
  };
  return [cx = curve(x), cy = curve(y), cz = curve(z)](double t) { return Vec3(cx(t), cy(t), cz(t)); };
}

}  // namespace tether
