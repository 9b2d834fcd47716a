#pragma once

#include <filesystem>
#include <string>

namespace tether {

/// Throws InputError unless texts can name a path, as the system finds it: in UTF-8, on one line.
void check_path(const std::filesystem::path& path);

/// What a file in `folder` means by this name, as the system finds it: a `..` behind a link leads out of what the link
/// leads to. Whoever reads a file of a case, counts what it holds or keeps it asks here, so that all mean the same one.
/// Throws InputError for one that is there and has a path that check_path refuses.
std::filesystem::path named_path(const std::filesystem::path& folder, const std::filesystem::path& name);

/// Where a file is, as a whole path through no link but the file itself.
std::filesystem::path place_of(const std::filesystem::path& file);

/// The name by which a file in `folder` means this one, through no link but the file itself.
std::string name_for(const std::filesystem::path& file, const std::filesystem::path& folder);

}  // namespace tether
