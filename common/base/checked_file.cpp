#include "common/base/checked_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <fstream>

#include "common/base/error.hpp"
#include "common/base/input_stream.hpp"
#include "common/base/write_error.hpp"

namespace tether {
namespace {

/// At the beginning of each file; all members are 8 bytes.
struct Header {
  std::array<char, 8> magic{'T', 'E', 'T', 'H', 'E', 'R', 'C', 'P'};
  std::uint64_t version = 11;
  std::uint64_t fingerprint = 0;
  std::int64_t step = 0;
  std::uint64_t size = 0;      ///< of the bytes that follow
  std::uint64_t checksum = 0;  ///< of these, and of what stands before it
};

std::uint64_t checksum_of(const Header& header, std::span<const std::byte> bytes) {
  return hash_bytes(bytes.data(), bytes.size(), hash_bytes(&header, offsetof(Header, checksum)));
}

}  // namespace

std::uint64_t hash_bytes(const void* data, std::size_t size, std::uint64_t seed) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::uint64_t hash = seed;
  for (std::size_t i = 0; i < size; i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes + i, std::min<std::size_t>(8, size - i));
    hash = (hash ^ word) * 1099511628211ull;
    hash ^= hash >> 32;
  }
  return hash;
}

void flush_to_disk(const std::filesystem::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY);
  const bool flushed = descriptor >= 0 && fsync(descriptor) == 0;
  if (descriptor >= 0) close(descriptor);
  if (!flushed) throw run_error("{}: cannot be written to the disk: {}", path.string(), std::strerror(errno));
}

void write_checked(const std::filesystem::path& path, std::uint64_t fingerprint, std::int64_t step,
                   std::span<const std::byte> bytes) {
  Header header{.fingerprint = fingerprint, .step = step, .size = bytes.size()};
  header.checksum = checksum_of(header, bytes);
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(&header), sizeof header);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw write_error(path);
  flush_to_disk(path);
}

CheckedContent read_checked(const std::filesystem::path& path) {
  Header header;
  std::ifstream file = input_stream(path, std::ios::binary);  // to open a pipe would wait without end
  file.read(reinterpret_cast<char*>(&header), sizeof header);
  if (!file || header.magic != Header{}.magic) throw input_error("{}: is no file of a checkpoint", path.string());
  if (header.version != Header{}.version)
    throw input_error("{}: was written by another version of Tether", path.string());
  if (std::filesystem::file_size(path) != sizeof(Header) + header.size)
    throw input_error("{}: is cut short", path.string());
  CheckedContent content{header.fingerprint, header.step, std::vector<std::byte>(header.size)};
  file.read(reinterpret_cast<char*>(content.bytes.data()), static_cast<std::streamsize>(content.bytes.size()));
  if (!file || checksum_of(header, content.bytes) != header.checksum)
    throw input_error("{}: is damaged (checksum)", path.string());
  return content;
}

}  // namespace tether
