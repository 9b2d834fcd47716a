#include "common/base/hash_file.hpp"

#include <fstream>

namespace tether {

std::uint64_t hash_file(const std::filesystem::path& path, std::uint64_t seed) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return seed;  // to open a pipe would wait without end
  std::ifstream file(path, std::ios::binary);
  std::vector<char> block(1 << 20);  // a multiple of what hash_bytes takes at a time
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0)
    seed = hash_bytes(block.data(), static_cast<std::size_t>(file.gcount()), seed);
  return seed;
}

}  // namespace tether
