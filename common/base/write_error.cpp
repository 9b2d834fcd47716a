#include "common/base/write_error.hpp"

namespace tether {

RunError write_error(const std::filesystem::path& file) {
  constexpr std::uintmax_t hardly_any = 64 * 1024;  // bytes: what was to be written is seldom less
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::absolute(file, error).parent_path();
  if (!std::filesystem::exists(folder, error))
    return run_error("{}: cannot be written: its folder is gone", file.string());
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  if (!error && space.capacity > 0 && space.available < hardly_any)  // what is no disk has no capacity
    return run_error("{}: cannot be written: no space is left on its disk", file.string());
  return run_error("{}: cannot be written", file.string());
}

}  // namespace tether
