#include "tether/new_results.hpp"

#include "common/base/whole_file.hpp"
#include "common/config/files_to_go_on_with.hpp"

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
  auto part = name.begin();
  fs::path place = folder_ / (".new_" + part->string());
  while (++part != name.end()) place /= *part;
  return place;
}

void NewResults::note(const std::vector<fs::path>& to_go_on_with) const {
  check_not_changed_meanwhile(folder_, to_go_on_with);  // also those that go
  std::vector<ComingFile> coming;
  for (const fs::path& name : to_go_on_with)
    if (fs::exists(beside(name))) coming.push_back({name, beside(name)});
  if (!coming.empty()) note_coming(folder_, coming);
}

void NewResults::put_in_place() const {
  for (const fs::path& name : names_) {
    if (!fs::exists(beside(name))) {
      fs::remove(folder_ / name);
      continue;
    }
    fs::create_directories((folder_ / name).parent_path());
    ::tether::put_in_place(beside(name), folder_ / name);
  }
}

void NewResults::remove() const {
  std::error_code none;
  for (const fs::path& name : names_) fs::remove_all(beside(*name.begin()), none);
}

}  // namespace tether
