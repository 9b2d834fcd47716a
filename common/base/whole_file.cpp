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
  try {
    if (!to) throw write_error(file);
    put_in_place(part, file);
  } catch (const RunError&) {
    fs::remove(part, none);
    throw;
  }
}

void put_in_place(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (!error) return;
  errno = error.value();
  throw write_error(to);
}

}  // namespace tether
