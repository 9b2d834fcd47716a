#include "observation_manager/measurements/velocity_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "observation_manager/measurements/stated_unit.hpp"

namespace tether {
namespace {

/// Columns of the file, in the case's units.
class Table {
 public:
  Table(const VelocitiesCase& given, const UnitSystem& units)
      : file(given.file), times(file.quantities("time", units, dimension::time)) {
    check_unit_of_time(file, given.beat.has_value());
    for (double& time : times) time = time * given.beat.value_or(1.0) + given.time_shift;
    for (std::size_t i = 0; i < 3; ++i) positions[i] = column(std::array{"x", "y", "z"}[i], dimension::length, units);
    const std::vector<std::string> names =
        given.components == "vector" ? std::vector<std::string>{"vx", "vy", "vz"} : std::vector<std::string>{"v"};
    for (const std::string& name : names) values.push_back(column(name, dimension::velocity, units));
  }
  std::size_t rows() const { return times.size(); }

  CsvTable file;
  std::vector<double> times;
  std::array<std::vector<double>, 3> positions;
  std::vector<std::vector<double>> values;  ///< by component

 private:
  std::vector<double> column(const std::string& name, Dimension dimension, const UnitSystem& units) const {
    std::vector<double> numbers = file.quantities(name, units, dimension);
    check_unit(file, name, units.symbol(dimension));
    return numbers;
  }
};

/// The different points of a table, and which of them each row is about.
struct Places {
  explicit Places(const Table& table) {
    std::map<std::array<double, 3>, int> numbers;
    std::vector<Vec3> found;
    for (std::size_t row = 0; row < table.rows(); ++row) {
      const std::array<double, 3> x{table.positions[0][row], table.positions[1][row], table.positions[2][row]};
      const auto [place, is_new] = numbers.emplace(x, static_cast<int>(found.size()));
      if (is_new) found.emplace_back(x.data());
      of_row.push_back(place->second);
    }
    points.resize(3, static_cast<Eigen::Index>(found.size()));
    for (std::size_t i = 0; i < found.size(); ++i) points.col(static_cast<Eigen::Index>(i)) = found[i];
  }
  Points points;
  std::vector<int> of_row;
};

/// A frame has a value for each point of the table: of points that move there would be as many as there are rows,
/// squared.
void check_size(const Table& table, const Places& places) {
  constexpr std::size_t most = 20'000'000;  // numbers
  std::size_t frames = 1;
  for (std::size_t row = 1; row < table.rows(); ++row)
    if (table.times[row] != table.times[row - 1]) ++frames;
  const auto points = static_cast<std::size_t>(places.points.cols());
  if (frames * points * table.values.size() > most)
    throw input_error("{}: has {} times and {} different points: all points at all times would be more than {} numbers",
                      table.file.where(table.rows() - 1), frames, points, most);
}

/// Rows of the same time, which must stand together, become a frame.
std::vector<VelocityFrame> frames_of(const Table& table, const Places& places) {
  const auto components = static_cast<Eigen::Index>(table.values.size());
  std::vector<VelocityFrame> frames;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const double time = table.times[row];
    if (!frames.empty() && time < frames.back().time)
      throw input_error("{}: the time {:g} comes after {:g}: the rows of a frame must stand together, in order",
                        table.file.where(row), time, frames.back().time);
    if (frames.empty() || time > frames.back().time)
      frames.push_back(
          {time, false,
           Components::Constant(components, places.points.cols(), std::numeric_limits<double>::quiet_NaN())});
    auto values = frames.back().values.col(places.of_row[row]);
    if (!std::isnan(values[0]))
      throw input_error("{}: the point has a velocity at {:g} already", table.file.where(row), time);
    for (Eigen::Index i = 0; i < components; ++i) values[i] = table.values[static_cast<std::size_t>(i)][row];
  }
  return frames;
}

void mark_held_out(std::vector<VelocityFrame>& frames, const std::vector<double>& numbers, const std::string& where) {
  for (const double number : numbers) {
    const auto frame = static_cast<std::size_t>(number);
    if (frame >= frames.size() || static_cast<double>(frame) != number)
      throw input_error("{}.held_out: there is no frame {:g}; frames are numbered 0 to {}", where, number,
                        frames.size() - 1);
    frames[frame].held_out = true;
  }
  if (std::all_of(frames.begin(), frames.end(), [](const VelocityFrame& frame) { return frame.held_out; }))
    throw input_error("{}.held_out: all {} frames: one at least must be left to the model", where, frames.size());
}

/// A series must fit its period; one that does not repeat must have something to say during the run.
void check_times(const std::vector<VelocityFrame>& frames, double period, const TimeCase& run,
                 const std::string& where) {
  const double first = frames.front().time, last = frames.back().time;
  if (period > 0 && last > first + period * (1 - 1e-9))
    throw input_error("{}: its frames are from {:g} to {:g}, beyond one period of {:g}", where, first, last, period);
  if (period <= 0 && (first > run.end || last < run.start))
    throw input_error("{}: its frames are from {:g} to {:g}, the run is from {:g} to {:g}: period or time_shift?",
                      where, first, last, run.start, run.end);
}

Eigen::Matrix<double, Eigen::Dynamic, 3> axes_of(const VelocitiesCase& given) {
  if (given.components == "vector") return Mat3::Identity();
  return given.direction.normalized().transpose();
}

}  // namespace

VelocitySeries load_velocities(const std::string& name, const VelocitiesCase& given, const CaseFile& file) {
  const std::string where = file.where("observations.velocities." + name);
  const Table table(given, file.units());
  Places places(table);
  check_size(table, places);
  std::vector<VelocityFrame> frames = frames_of(table, places);
  mark_held_out(frames, given.held_out, where);
  const double period = given.beat.value_or(given.period.value_or(0));
  check_times(frames, period, file.common().time, where);
  return VelocitySeries({name, axes_of(given), period, 0.5 * file.common().time.step, noise_of(given.noise)},
                        std::move(places.points), std::move(frames));
}

}  // namespace tether
