#include "solid/motion_case.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/base/shortened.hpp"
#include "common/config/columns.hpp"

namespace tether {
namespace {

/// Most that the cosine between two axes may be: they are typed with a few digits.
constexpr double most_cosine = 0.02;

/// One point a row of the file, its coordinates by `numbers(column)`.
template <class Numbers>
Points vectors(const CsvTable& table, const std::vector<std::string>& columns, const Numbers& numbers) {
  Points result(3, static_cast<Eigen::Index>(table.rows()));
  for (Eigen::Index c = 0; c < 3; ++c) {
    const std::vector<double> values = numbers(columns[static_cast<std::size_t>(c)]);
    result.row(c) = Eigen::Map<const Eigen::RowVectorXd>(values.data(), result.cols());
  }
  return result;
}

Points turns_of(const CsvTable& table, const std::vector<std::string>& columns) {
  return vectors(table, columns, [&](const std::string& column) {
    const std::string unit = table.unit(column);
    if (!unit.empty() && unit != "rad" && unit != "deg")
      throw input_error("{}: column '{}': a turn is in rad or deg, not in {}", table.where(0), column, unit);
    std::vector<double> values = table.numbers(column);
    if (unit == "deg")
      for (double& value : values) value *= std::numbers::pi / 180;
    return values;
  });
}

/// The rows of each time, in the order of the file. Throws InputError if a time does not come after those before.
std::vector<std::vector<std::size_t>> rows_by_time(const CsvTable& table, const std::vector<double>& times,
                                                   bool many_rows_a_time) {
  std::vector<std::vector<std::size_t>> result;
  for (std::size_t row = 0; row < times.size(); ++row) {
    const bool same = row > 0 && times[row] == times[row - 1];
    if (row > 0 && (times[row] < times[row - 1] || (same && !many_rows_a_time)))
      throw input_error("{}: the time {} does not come after {}", table.where(row), times[row], times[row - 1]);
    if (!same) result.emplace_back();
    result.back().push_back(row);
  }
  return result;
}

/// The points of each time, in the order of the first. Throws InputError if a time has others than the first.
std::vector<Points> marks_of(const CsvTable& table, const std::vector<std::string>& names, const Points& positions,
                             const std::vector<std::vector<std::size_t>>& rows) {
  std::map<std::string, Eigen::Index> place;
  for (const std::size_t row : rows.front())
    if (!place.emplace(names[row], static_cast<Eigen::Index>(place.size())).second)
      throw input_error("{}: the point {} is there twice at this time", table.where(row), shortened(names[row]));
  if (place.size() < 3) throw input_error("{}: {} points at a time; a pose needs three", table.where(0), place.size());
  std::vector<Points> result;
  for (const auto& at_time : rows) {
    Points marks = Points::Constant(3, static_cast<Eigen::Index>(place.size()), undefined);
    for (const std::size_t row : at_time) {
      const auto found = place.find(names[row]);
      if (found == place.end())
        throw input_error("{}: the point {} is not there at the first time", table.where(row), shortened(names[row]));
      marks.col(found->second) = positions.col(static_cast<Eigen::Index>(row));
    }
    if (at_time.size() != place.size() || marks.hasNaN())
      throw input_error("{}: {} points at this time, {} at the first; all must be there, each once",
                        table.where(at_time.front()), at_time.size(), place.size());
    result.push_back(std::move(marks));
  }
  return result;
}

Poses read_poses(const MotionCase& given, const CsvTable& table, const UnitSystem& units) {
  std::vector<double> times;
  if (given.clock == "phase") {
    if (const std::string unit = table.unit(given.time); !unit.empty())
      throw input_error("{}: {} is in {}, but with clock: phase times are parts of the period: must have no unit",
                        table.where(0), given.time, unit);
    times = table.numbers(given.time);
    for (double& time : times) time *= *given.period;
  } else {
    times = table.quantities(given.time, units, dimension::time);
  }
  const bool of_points = given.table == "points";
  const auto rows = rows_by_time(table, times, of_points);
  const Points positions = vectors(table, {given.x, given.y, given.z}, [&](const std::string& column) {
    return table.quantities(column, units, dimension::length, given.unit);
  });
  if (of_points) {
    std::vector<double> each;
    for (const auto& at_time : rows) each.push_back(times[at_time.front()]);
    return poses_of(std::move(each), marks_of(table, table.texts(given.point), positions, rows));
  }
  const Points turns = given.table == "poses" ? turns_of(table, given.turn) : Points(Points::Zero(3, positions.cols()));
  return {std::move(times), positions, turns, 0};
}

}  // namespace

void PlacementCase::declare(Fields& f) {
  f.direction("x_axis", x_axis, "direction, in the model, of the table's x axis");
  f.direction("y_axis", y_axis, "direction, in the model, of the table's y axis; z follows by the right hand");
  f.check(!(std::abs(x_axis.normalized().dot(y_axis.normalized())) > most_cosine), "y_axis",
          "must be at a right angle to x_axis");
}

Mat3 PlacementCase::rotation() const {
  Mat3 result;
  result.col(0) = x_axis.normalized();
  result.col(2) = x_axis.cross(y_axis).normalized();
  result.col(1) = result.col(2).cross(result.col(0));
  return result;
}

void MotionCase::declare(Fields& f) {
  f.path("file", file, "CSV file with the ring's motion over time", Need::required);
  f.choice("table", table,
           {{"displacement", "a row for each time: where a point of the ring has gone; the ring does not turn"},
            {"poses", "a row for each time: the ring's centre, and its turn as axis times angle in radians"},
            {"points", "a row for each point of the ring and time: the same points at all times"}},
           "what the file holds");
  f.choice("clock", clock, {{"time", "times"}, {"phase", "parts of the period"}}, "what the column of the time holds");
  f.text("time", time, "column of the time");
  f.text("x", x, "column of the x coordinate");
  f.text("y", y, "column of the y coordinate");
  f.text("z", z, "column of the z coordinate");
  f.text("unit", unit, "of the coordinates, if their headings do not state it as [unit]; else the case's");
  f.when("table", table, {"points"}, [&] {
    f.text("point", point, "column that tells the points apart");
    check_column(f, "point", point, file);
  });
  f.when("table", table, {"poses"}, [&] {
    f.texts("turn", turn, "columns of the turn about x, y and z [rad]");
    f.check(turn.size() == 3, "turn", "must be three columns");
    for (const std::string& column : turn) check_column(f, "turn", column, file);
  });
  f.number("period", period, dimension::time, range::positive,
           "duration after which the motion repeats; absent: it does not");
  f.integer("harmonics", harmonics, {0, 20},
            "of the Fourier series that is fitted to the centre and the turn, so that the motion is smooth; 0: linear "
            "between the times of the table");
  f.choice("follow", follow,
           {{"rigid", "the ring moves and turns as the table says"},
            {"centre", "it moves with its centre, without turning"}},
           "what of the motion is followed");
  f.group("placement", placement,
          "how the table's frame lies in the model's, about the ring's centre; absent: the frames are the same");
  for (const auto& [field, column] : {std::pair{"time", time}, {"x", x}, {"y", y}, {"z", z}})
    check_column(f, field, column, file);
  f.check(period.has_value() || harmonics == 0, "harmonics", "needs 'period'");
  f.check(period.has_value() || clock == "time", "clock", "phase needs 'period'");
}

RigidMotion MotionCase::load(const UnitSystem& units, const Patch& moved, const Points& points) const {
  const CsvTable csv(file);
  MotionShape shape{.period = period, .harmonics = std::nullopt, .turns = follow == "rigid"};
  if (harmonics > 0) shape.harmonics = harmonics;
  Placement placed;
  if (placement) placed = {placement->rotation(), points(Eigen::all, nodes_of(moved.triangles)).rowwise().mean()};
  const Poses poses = read_poses(*this, csv, units);
  try {
    return {poses, shape, placed};
  } catch (const InputError& error) {
    throw input_error("{}: {}", file.string(), error.what());
  }
}

std::string describe(const RigidMotion& motion, const MotionCase& given, const UnitSystem& units) {
  const auto mm = [&](double length) { return fmt::format("{:.2g} mm", units.to_mm(length)); };
  std::string text = fmt::format("moves as {} says, its centre by {} at most", given.file.filename().string(),
                                 mm(motion.largest_way()));
  if (given.table == "points")
    text += fmt::format("; its points are off a rigid body's by {} (rms)", mm(motion.point_misfit()));
  if (given.harmonics > 0)
    text += fmt::format("; {} harmonics leave {} and {:.1f} degrees (rms)", given.harmonics,
                        mm(motion.centre_residual()), motion.turn_residual() * 180 / std::numbers::pi);
  return text;
}

}  // namespace tether
