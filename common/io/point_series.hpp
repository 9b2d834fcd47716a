#pragma once

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "common/base/checked_file.hpp"
#include "common/base/types.hpp"

/// A vector at each of some points over a run: after a line of text that says what it is, the number of points and
/// their positions (int64, doubles), then for each step its time (double) and the vectors (floats: to 1e-7 of
/// themselves), x y z of point after point, little-endian. Behind the positions and behind each record stands the
/// checksum (uint64, `hash_bytes`) of it and of all before.
namespace tether {

/// What a file holds.
struct PointSeriesKind {
  std::string title;  ///< its first line: "Tether lumen motion 2"
  std::string what;   ///< "motion of a lumen"
};

class PointSeriesWriter {
 public:
  PointSeriesWriter(PointSeriesKind kind, std::filesystem::path path, Points points);

  /// A new file.
  void start();
  /// Goes on behind the first `records` records of the file; later ones are dropped, damaged or not. Throws InputError
  /// if the file is of other points, has fewer, others than those of the checksum, or damaged ones; it is as it was
  /// then.
  void resume(std::int64_t records, std::uint64_t checksum);
  /// To be read by others when this returns. Throws RunError if it cannot be written.
  void append(double time, const Points& vectors);
  /// To the disk: what a checkpoint counts on must outlast a loss of power. Throws RunError.
  void flush() const { flush_to_disk(path_); }
  const Points& points() const { return points_; }
  /// Of all records so far.
  std::uint64_t checksum() const { return checksum_; }

 private:
  PointSeriesKind kind_;
  std::filesystem::path path_;
  Points points_;
  std::uint64_t checksum_ = 0;  ///< of all so far
  std::ofstream file_;
};

/// Such a file, read back.
class PointSeries {
 public:
  static constexpr auto all_records = std::numeric_limits<std::int64_t>::max();

  /// Of at most so many records. Throws InputError for a file that is none, or of which these are damaged. What a run
  /// that was killed has half written is no record.
  PointSeries(const PointSeriesKind& kind, const std::filesystem::path& path, std::int64_t most = all_records);
  /// Throws InputError if the file holds fewer than the state at the start and those after so many steps: it was cut.
  void check_has(std::int64_t steps) const;

  const Points& points() const { return points_; }
  const std::vector<double>& times() const { return times_; }
  /// The checksum behind the first so many records.
  std::uint64_t checksum_after(std::int64_t records) const { return checksums_[static_cast<std::size_t>(records)]; }
  /// Linear between steps. Throws InputError for a time outside the run.
  Points vectors_at(double time) const;

 private:
  Points vectors(std::size_t record) const;

  std::filesystem::path path_;
  Points points_;
  std::vector<double> times_;
  std::vector<float> vectors_;
  std::vector<std::uint64_t> checksums_;  ///< behind the positions, then behind each record
};

}  // namespace tether
