#pragma once

#include <cstring>
#include <string>

#include "common/base/checked_file.hpp"

/// Files with the checksums that belong to their bytes: no fuzzer finds those by itself.
namespace tether::fuzz {

inline void put(std::string& bytes, std::size_t at, std::uint64_t number) {
  std::memcpy(bytes.data() + at, &number, sizeof number);
}

/// A series of vectors at points (point_series.hpp).
inline std::string with_checksums(std::string bytes) {
  std::size_t at = bytes.find('\n') + 1;
  std::uint64_t count = 0;
  if (at == 0 || at + sizeof count > bytes.size()) return bytes;
  std::memcpy(&count, bytes.data() + at, sizeof count);
  if (count > bytes.size()) return bytes;
  at += sizeof count;
  const std::size_t points = 24 * count, vectors = 12 * count;
  if (at + points + 8 > bytes.size()) return bytes;
  std::uint64_t checksum = hash_bytes(bytes.data() + at, points);
  put(bytes, at += points, checksum);
  for (at += 8; at + 8 + vectors + 8 <= bytes.size(); at += 8) {
    checksum = hash_bytes(bytes.data() + at + 8, vectors, hash_bytes(bytes.data() + at, 8, checksum));
    put(bytes, at += 8 + vectors, checksum);
  }
  return bytes;
}

}  // namespace tether::fuzz
