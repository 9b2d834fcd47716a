#include "common/io/lumen_motion.hpp"

#include <fmt/format.h>

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/base/hash_file.hpp"

namespace tether {
namespace {

const PointSeriesKind motion{"Tether lumen motion 2", "motion of a lumen"};
const PointSeriesKind velocity{"Tether blood velocity 2", "blood's velocity"};

}  // namespace

LumenMotionWriter::LumenMotionWriter(std::filesystem::path path, Points imaged)
    : PointSeriesWriter(motion, std::move(path), std::move(imaged)) {}

LumenMotion::LumenMotion(const std::filesystem::path& path) : series_(motion, path) {}

BloodVelocityWriter::BloodVelocityWriter(std::filesystem::path path, Points points)
    : PointSeriesWriter(velocity, std::move(path), std::move(points)) {}

BloodVelocity::BloodVelocity(const std::filesystem::path& path) : PointSeries(velocity, path) {}

void check_has_rows(const std::filesystem::path& table, std::int64_t steps) {
  if (const std::size_t rows = CsvTable(table, TableOf::tether).rows(); rows < static_cast<std::size_t>(steps))
    throw input_error("{}: is cut short: it has {} rows of a run of {} steps", table.string(), rows, steps);
}

void check_is_whole(const std::filesystem::path& folder, std::int64_t steps) {
  LumenMotion(folder / "lumen.motion").check_has(steps);
  if (const auto velocities = folder / "blood.velocity"; std::filesystem::exists(velocities))
    BloodVelocity(velocities).check_has(steps);
  check_has_rows(folder / "timeseries.csv", steps);
}

std::map<std::string, std::string> hashes_of_results(const std::filesystem::path& folder) {
  std::map<std::string, std::string> hashes;
  for (const char* name : {"timeseries.csv", "lumen.motion", "blood.velocity"})
    if (std::filesystem::exists(folder / name)) hashes[name] = fmt::format("{:016x}", hash_file(folder / name, 0));
  return hashes;
}

}  // namespace tether
