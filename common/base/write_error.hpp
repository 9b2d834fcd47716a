#pragma once

#include <filesystem>

#include "common/base/error.hpp"

namespace tether {

/// What to throw where a file cannot be written: it names the file, and why if that can be seen: its folder is gone,
/// its disk is full, or what the call that failed last has said (quota, failure, no permission). To be called before
/// others.
RunError write_error(const std::filesystem::path& file);
/// Makes a folder in one that is there: one that was removed meanwhile is not made anew. Throws as above.
void make_folder(const std::filesystem::path& folder);
/// Makes a folder and those it is in, but never `there`, where it is below that: `there` may have been removed, and in
/// what is made in its place nobody would find whose it is. Throws as above.
void make_folders_below(const std::filesystem::path& there, const std::filesystem::path& folder);
/// Throws "FOLDER: cannot be made: CAUSE": InputError for what the person may not do (no permission, a file is there),
/// RunError for what the disk cannot (full, quota, failure). what: "cannot be made", "cannot be written to".
[[noreturn]] void refuse_folder(const std::filesystem::path& folder, const char* what, int error_number);

}  // namespace tether
