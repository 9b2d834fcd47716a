#pragma once

#include <filesystem>
#include <string>

namespace tether {

/// Makes a folder this process's own until it, and the programs that it started, have ended; again: nothing happens.
/// A program that the holder started (`holder_variable` is in its environment) may use it as well. Another
/// holder is given two seconds to end, and the programs of one that was killed ten. On a file system without locks
/// nothing is held. Throws InputError, naming the other process, if the folder is another's, or cannot be written to.
void hold_folder(const std::filesystem::path& folder);

/// Throws RunError if a folder that this process holds, or uses beside its holder, was removed or taken by another.
void check_held(const std::filesystem::path& folder);

/// The same of all folders of this process.
void check_all_held();

/// In the environment of programs that work in folders which this process holds: its name.
inline constexpr const char* holder_variable = "TETHER_HOLDER";

/// "HOST:PID" of this process.
std::string holder_name();

/// The file by which folders are held. It stays when nobody holds them.
inline constexpr const char* folder_lock_name = ".lock";

}  // namespace tether
