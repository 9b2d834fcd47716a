#pragma once

#include <filesystem>

#include "identification_master/identification.hpp"

namespace tether {

/// OUTPUT/checkpoint/identification.bin: written beside the old one, flushed, renamed. Throws RunError if the disk
/// refuses.
void write_checkpoint(const std::filesystem::path& output, std::uint64_t fingerprint, const IdentificationState& state);

/// Throws InputError: none, damaged, of another case.
IdentificationState read_checkpoint(const std::filesystem::path& output, std::uint64_t fingerprint);

}  // namespace tether
