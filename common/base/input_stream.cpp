#include "common/base/input_stream.hpp"

#include <linux/magic.h>
#include <sys/vfs.h>

#include <array>

#include "common/base/error.hpp"

namespace tether {
namespace {

/// Whether the kernel makes its content as it is read (/proc, /sys): some of these wait for what is to come.
bool is_made_by_kernel(const std::filesystem::path& file) {
  struct statfs of {};
  if (statfs(file.c_str(), &of) != 0) return false;
  const auto kind = static_cast<std::uint64_t>(of.f_type);
  return kind == PROC_SUPER_MAGIC || kind == SYSFS_MAGIC || kind == DEBUGFS_MAGIC || kind == TRACEFS_MAGIC;
}

}  // namespace

std::ifstream input_stream(const std::filesystem::path& file, std::ios::openmode mode, std::uintmax_t most) {
  std::error_code unknown;
  if (!std::filesystem::exists(file, unknown)) throw input_error("{}: no such file", file.string());
  if (!std::filesystem::is_regular_file(file, unknown) || is_made_by_kernel(file))
    throw input_error("{}: is not a file", file.string());
  if (const std::uintmax_t size = std::filesystem::file_size(file, unknown); size > most)
    throw input_error("{}: has {:.0f} MB: larger than any such file that is read here ({} MB)", file.string(),
                      static_cast<double>(size) / 1e6, most / 1'000'000);
  std::ifstream stream(file, mode);
  if (!stream) throw input_error("{}: cannot be opened", file.string());
  return stream;
}

std::string content_of(const std::filesystem::path& file, std::uintmax_t most) {
  std::ifstream stream = input_stream(file, std::ios::binary, most);
  std::error_code unknown;
  std::string content;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  if (!unknown) content.reserve(size);  // growing by doubling takes three times as much
  for (std::array<char, 1 << 16> block{}; stream;) {
    stream.read(block.data(), block.size());
    content.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  }
  return content;
}

}  // namespace tether
