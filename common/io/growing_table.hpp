#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "common/base/checked_file.hpp"

namespace tether {

/// A table on the disk that grows by a row a step, below a line of headings. A checkpoint keeps the number of its rows
/// and their checksum, not the rows.
class GrowingTable {
 public:
  GrowingTable(std::filesystem::path path, std::string headings);

  /// A new file with its headings.
  void start();
  /// Goes on behind the first `rows` rows of the file; later ones are dropped. Throws InputError if the file has other
  /// headings, fewer rows or others than those of the checksum; it is as it was then.
  void resume(std::int64_t rows, std::uint64_t checksum);
  /// To be read by others when this returns. Throws RunError if it cannot be written.
  void append(const std::string& row) { write(row); }
  /// To the disk: what a checkpoint counts on must outlast a loss of power. Throws RunError.
  void flush() const { flush_to_disk(path_); }
  /// Of the headings and all rows so far.
  std::uint64_t checksum() const { return checksum_; }

 private:
  void open(std::ios::openmode mode);
  void write(const std::string& line);

  std::filesystem::path path_;
  std::string headings_;
  std::uint64_t checksum_ = 0;
  std::ofstream file_;
};

}  // namespace tether
