#pragma once

#include <filesystem>

namespace tether {

/// Where files stand that end with their process: TMPDIR, or /tmp. Throws InputError if there is no such folder.
std::filesystem::path temporary_folder();

}  // namespace tether
