#include "common/base/whole_file.hpp"

#include <cerrno>
#include <fstream>

#include "common/base/write_error.hpp"

namespace tether {

namespace fs = std::filesystem;

void write_whole(const fs::path& file, std::string_view bytes) {
  const fs::path part = file.string() + ".part";
  std::error_code none;
  fs::remove(part, none);  // whatever is there in its place, a link to another file
  std::ofstream to(part, std::ios::binary);
  to.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  to.close();
  std::error_code error;
  if (to) fs::rename(part, file, error);
  if (to && !error) return;
  if (error) errno = error.value();
  const RunError told = write_error(file);
  fs::remove(part, none);
  throw told;
}

}  // namespace tether
