#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tether {

/// A ParaView collection: files and their times. The file on disk is complete after every `add`.
class PvdSeries {
 public:
  /// A new, empty series; nothing is written before the first `add`.
  explicit PvdSeries(std::filesystem::path path) : path_(std::move(path)) {}
  /// The series found at `path`, cut after `last_time`; empty if there is none. Throws InputError if the file is no
  /// series, or one of its entries has no time or no file.
  static PvdSeries resumed(std::filesystem::path path, double last_time);
  /// The same of a series that this class wrote, without files that are gone, and of a damaged one what it still
  /// names; both are told on stderr.
  static PvdSeries rescued(const std::filesystem::path& path, double last_time);
  /// The same without what it has at `time` already, or later: that is written now.
  static PvdSeries rescued_before(const std::filesystem::path& path, double time);

  /// file: as seen from the series' folder. Throws RunError if the series cannot be written.
  void add(double time, const std::string& file);
  const std::vector<std::pair<double, std::string>>& entries() const { return entries_; }

 private:
  std::filesystem::path path_;
  std::vector<std::pair<double, std::string>> entries_;
};

}  // namespace tether
