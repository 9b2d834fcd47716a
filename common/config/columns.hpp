#pragma once

#include <filesystem>
#include <string>

#include "common/config/fields.hpp"

namespace tether {

/// A rule of a section: its table has the column that a field names. (A table that cannot be read at all is refused by
/// who reads it.)
void check_column(Fields& f, Fields::Text field, const std::string& column, const std::filesystem::path& file);

}  // namespace tether
