#include "common/io/growing_table.hpp"

#include <fmt/format.h>

#include "common/base/error.hpp"
#include "common/base/whole_file.hpp"
#include "common/base/write_error.hpp"

namespace tether {

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
  std::ifstream old(path_);
  std::string line, kept;
  if (!std::getline(old, line) || line != headings_)
    throw input_error("{}: is not the table that the checkpoint belongs to (other headings, or no file)",
                      path_.string());
  kept = line + "\n";
  std::uint64_t found = hash_values(line, 0);
  for (std::int64_t row = 0; row < rows; ++row) {
    if (!std::getline(old, line)) throw input_error("{}: has {} rows, the checkpoint {}", path_.string(), row, rows);
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
