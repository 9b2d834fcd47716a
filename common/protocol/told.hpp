#pragma once

#include <filesystem>

namespace tether::protocol {

/// What the programs of a run have told the person on stderr about its end.
enum class Told { nothing, failure, interruption };

/// The environment variable that names the file by which they let the front-end know.
inline constexpr const char* told_variable = "TETHER_TOLD";

/// By a program that has told it; nothing happens if nobody wants to know.
void note_told(Told what);
/// By the front-end; the file is gone then.
Told take_note(const std::filesystem::path& file);

}  // namespace tether::protocol
