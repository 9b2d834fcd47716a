#include "common/config/columns.hpp"

#include "common/base/csv.hpp"
#include "common/base/error.hpp"
#include "common/base/shortened.hpp"

namespace tether {
namespace {

/// Nothing if the file is no table.
std::optional<CsvTable> table_in(const std::filesystem::path& file) {
  if (file.empty() || !std::filesystem::is_regular_file(file)) return std::nullopt;
  try {
    return CsvTable(file);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

void check_column(Fields& f, Fields::Text field, const std::string& column, const std::filesystem::path& file) {
  const std::optional<CsvTable> table = table_in(file);
  if (!table || table->has(column)) return;
  f.check(false, field,
          fmt::format("{} has no column '{}'; its columns are {}", file.string(), shortened(column),
                      table->listed_columns()));
}

}  // namespace tether
