#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

/// Files that must be whole or refused: checkpoints.
namespace tether {

/// FNV-1a over bytes, in words of eight.
std::uint64_t hash_bytes(const void* data, std::size_t size, std::uint64_t seed = 14695981039346656037ull);

/// The same of all that a container holds, plain numbers one after the other.
template <class Values>
std::uint64_t hash_values(const Values& values, std::uint64_t seed) {
  return hash_bytes(values.data(), sizeof(*values.data()) * static_cast<std::size_t>(values.size()), seed);
}

/// Gives a file or folder to the disk before it is renamed. Throws RunError.
void flush_to_disk(const std::filesystem::path& path);

/// What a file holds, beside whose it is.
struct CheckedContent {
  std::uint64_t fingerprint = 0;  ///< of the case
  std::int64_t step = 0;
  std::vector<std::byte> bytes;
};

/// Writes a file with its checksum, and flushes it. Throws RunError if the disk refuses.
void write_checked(const std::filesystem::path& path, std::uint64_t fingerprint, std::int64_t step,
                   std::span<const std::byte> bytes);

/// Throws InputError for a file that is none of these, of another version, cut short or damaged.
CheckedContent read_checked(const std::filesystem::path& path);

}  // namespace tether
