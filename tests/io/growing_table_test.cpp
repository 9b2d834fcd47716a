#include "common/io/growing_table.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "common/base/error.hpp"
#include "tests/io/temporary_folder.hpp"

namespace tether {
namespace {

constexpr const char* headings = "time [s], value, more";

/// A table of some rows with the largest and longest of numbers.
struct Table {
  TemporaryFolder folder;
  std::filesystem::path path = folder / "t.csv";
  std::uint64_t checksum = 0;
  explicit Table(int rows) {
    GrowingTable table(path, headings);
    table.start();
    for (int row = 0; row < rows; ++row)
      table.append(fmt::format("{}, {}, {}", row, -2.2250738585072014e-308, -1.7976931348623157e308));
    checksum = table.checksum();
  }
  std::string refused(int rows) const {
    return message_of([&] { GrowingTable(path, headings).resume(rows, checksum); });
  }
};

TEST(GrowingTable, GoesOnBehindLongRows) {
  const Table table(3);
  const auto size = std::filesystem::file_size(table.path);
  GrowingTable again(table.path, headings);
  again.resume(3, table.checksum);
  EXPECT_EQ(again.checksum(), table.checksum);
  EXPECT_EQ(std::filesystem::file_size(table.path), size);
  again.append("4, 5, 6");
  EXPECT_EQ(std::filesystem::file_size(table.path), size + 8);
}

/// What this process has taken at most [MB].
long peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024;
}

/// A disk gives back zeros for what was lost: no line ends there.
TEST(GrowingTable, ADamagedOneWithoutLineEndsIsNotReadWhole) {
  constexpr std::uintmax_t large = std::uintmax_t{1} << 30;
  const Table table(3);
  const long before = peak_memory();
  const auto size = std::filesystem::file_size(table.path);
  std::filesystem::resize_file(table.path, size - 30);
  std::filesystem::resize_file(table.path, large);
  EXPECT_EQ(table.refused(3), table.path.string() + ": was changed: its first 3 rows are not those that the run wrote");
  std::filesystem::resize_file(table.path, 0);
  std::filesystem::resize_file(table.path, large);
  EXPECT_EQ(table.refused(3),
            table.path.string() + ": is not the table that the checkpoint belongs to (other headings)");
  EXPECT_LT(peak_memory(), before + 64);
}

TEST(GrowingTable, WhatIsNoFileIsRefused) {
  const Table table(1);
  std::filesystem::remove(table.path);
  EXPECT_EQ(table.refused(1), table.path.string() + ": no such file");
  std::filesystem::create_directory(table.path);
  EXPECT_EQ(table.refused(1), table.path.string() + ": is not a file");
}

}  // namespace
}  // namespace tether
