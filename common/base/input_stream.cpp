#include "common/base/input_stream.hpp"

#include "common/base/error.hpp"

namespace tether {

std::ifstream input_stream(const std::filesystem::path& file, std::ios::openmode mode) {
  std::error_code unknown;
  if (!std::filesystem::exists(file, unknown)) throw input_error("{}: no such file", file.string());
  if (!std::filesystem::is_regular_file(file, unknown)) throw input_error("{}: is not a file", file.string());
  std::ifstream stream(file, mode);
  if (!stream) throw input_error("{}: cannot be opened", file.string());
  return stream;
}

}  // namespace tether
