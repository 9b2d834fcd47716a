#include "common/base/write_error.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace tether {

namespace {

/// Whether the last call that failed can have been the one that writes: others leave other numbers.
bool is_of_writing(int error_number) {
  constexpr std::array causes{EDQUOT, EIO, EACCES, EPERM, EROFS, EFBIG, EMFILE, ENFILE, EISDIR, ENAMETOOLONG, ESTALE};
  return std::find(causes.begin(), causes.end(), error_number) != causes.end();
}

}  // namespace

RunError write_error(const std::filesystem::path& file) {
  const int error_number = errno;
  constexpr std::uintmax_t hardly_any = 64 * 1024;  // bytes: what was to be written is seldom less
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::absolute(file, error).parent_path();
  if (!std::filesystem::exists(folder, error))
    return run_error("{}: cannot be written: its folder is gone", file.string());
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  const bool is_full = !error && space.capacity > 0 && space.available < hardly_any;  // what is no disk has no capacity
  if (is_full || error_number == ENOSPC)
    return run_error("{}: cannot be written: no space is left on its disk", file.string());
  if (is_of_writing(error_number))
    return run_error("{}: cannot be written: {}", file.string(), std::strerror(error_number));
  return run_error("{}: cannot be written", file.string());
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::create_directory(folder, error) && error) throw write_error(folder);
}

void make_folders_below(const std::filesystem::path& there, const std::filesystem::path& folder) {
  const std::filesystem::path root = std::filesystem::absolute(there);
  const std::filesystem::path below = std::filesystem::absolute(folder).lexically_relative(root);
  if (below.empty() || *below.begin() == "..") {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw write_error(folder);
    return;
  }
  std::filesystem::path made = root;
  for (const std::filesystem::path& part : below) make_folder(made /= part);
}

void refuse_folder(const std::filesystem::path& folder, const char* what, int error_number) {
  const bool is_of_disk = error_number == ENOSPC || error_number == EDQUOT || error_number == EIO;
  const std::string text = fmt::format("{}: {}: {}", folder.string(), what, std::strerror(error_number));
  if (is_of_disk) throw RunError(text);
  throw InputError(text);
}

}  // namespace tether
