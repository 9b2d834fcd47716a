#include "tether/new_results.hpp"

#include "common/base/whole_file.hpp"
#include "common/config/output_folder.hpp"

namespace tether {

namespace fs = std::filesystem;

NewResults::NewResults(fs::path folder, std::vector<fs::path> names)
    : folder_(std::move(folder)), names_(std::move(names)) {
  remove();
}

NewResults::~NewResults() {
  remove();
}

fs::path NewResults::beside(const fs::path& name) const {
  return folder_ / name.parent_path() / (".new_" + name.filename().string());
}

void NewResults::put_in_place() const {
  for (const fs::path& name : names_)
    if (fs::exists(beside(name)))
      ::tether::put_in_place(beside(name), folder_ / name);
    else
      fs::remove(folder_ / name);
}

void NewResults::remove() const {
  std::error_code none;
  for (const fs::path& name : names_) fs::remove(beside(name), none);
}

void note_just_made(const fs::path& folder, const std::vector<fs::path>& files) {
  try {
    note_made(folder, files);
  } catch (...) {
    std::error_code none;
    for (const fs::path& file : files) fs::remove(folder / file, none);
    throw;
  }
}

}  // namespace tether
