#include "common/base/temporary_folder.hpp"

#include <cstdlib>

#include "common/base/error.hpp"
#include "common/base/write_error.hpp"

namespace tether {

std::filesystem::path temporary_folder() {
  std::error_code error;
  std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  if (!error) folder = std::filesystem::absolute(folder, error);  // programs of a run need not work where this one does
  if (!error) return folder;
  const char* given = std::getenv("TMPDIR");
  throw input_error("TMPDIR: {}: must name a folder, for the notes that a run's programs leave each other",
                    given ? given : "not given, and there is no /tmp");
}

ScratchFolder::ScratchFolder(const std::string& name) {
  std::string made = (temporary_folder() / (name + "_XXXXXX")).string();
  if (mkdtemp(made.data()) == nullptr) throw write_error(made);
  path_ = made;
}

ScratchFolder::~ScratchFolder() {
  std::error_code none;
  std::filesystem::remove_all(path_, none);
}

}  // namespace tether
