#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tether {

/// Pieces of text and what takes their place.
using Edits = std::vector<std::pair<std::string, std::string>>;

/// A copy of the folder of `case_file` as `folder`, with every occurrence of the pieces of `edits` in the case file
/// replaced. Returns the copy of the case file. Throws RunError if the case does not hold a piece.
std::filesystem::path case_variant(const std::filesystem::path& case_file, const std::filesystem::path& folder,
                                   const Edits& edits);

/// What a file holds. Throws RunError if it cannot be read.
std::string content_of(const std::filesystem::path& file);

}  // namespace tether
