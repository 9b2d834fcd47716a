#include "common/io/growing_table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/base/error.hpp"
#include "common/base/input_stream.hpp"
#include "common/base/whole_file.hpp"
#include "common/base/write_error.hpp"

namespace tether {
namespace {

/// The next line; of one that is longer than `longest`, a character more: a damaged file may have no line ends.
bool read_line(std::istream& from, std::string& line, std::size_t longest) {
  line.clear();
  for (char next = 0; line.size() <= longest && from.get(next);) {
    if (next == '\n') return true;
    line += next;
  }
  return !line.empty();
}

/// A number below each heading, and what parts it from the next.
std::size_t longest_row(const std::string& headings) {
  constexpr std::size_t longest_number = 24, parting = 2;  // characters: -2.2250738585072014e-308
  return (static_cast<std::size_t>(std::count(headings.begin(), headings.end(), ',')) + 1) * (longest_number + parting);
}

}  // namespace

GrowingTable::GrowingTable(std::filesystem::path path, std::string headings)
    : path_(std::move(path)), headings_(std::move(headings)) {}

void GrowingTable::open(std::ios::openmode mode) {
  file_ = std::ofstream(path_, mode);
  if (!file_) throw write_error(path_);
}

void GrowingTable::start() {
  open(std::ios::trunc);
  checksum_ = 0;
  write(headings_);
}

void GrowingTable::write(const std::string& line) {
  checksum_ = hash_values(line, checksum_);
  file_ << line << std::endl;
  if (!file_) throw write_error(path_);
}

void GrowingTable::resume(std::int64_t rows, std::uint64_t checksum) {
  std::ifstream old = input_stream(path_);
  std::string line, kept;
  if (!read_line(old, line, headings_.size()) || line != headings_)
    throw input_error("{}: is not the table that the checkpoint belongs to (other headings)", path_.string());
  kept = line + "\n";
  const std::size_t longest = longest_row(headings_);
  std::uint64_t found = hash_values(line, 0);
  for (std::int64_t row = 0; row < rows; ++row) {
    if (!read_line(old, line, longest))
      throw input_error("{}: has {} rows, the checkpoint {}", path_.string(), row, rows);
    kept += line + "\n";
    found = hash_values(line, found);
  }
  if (found != checksum)
    throw input_error("{}: was changed: its first {} rows are not those that the run wrote", path_.string(), rows);
  checksum_ = checksum;
  write_whole(path_, kept);
  open(std::ios::app);
}

}  // namespace tether
