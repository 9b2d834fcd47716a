#include "common/config/named_path.hpp"

#include <algorithm>

#include "common/base/error.hpp"
#include "common/base/name.hpp"

namespace tether {

namespace fs = std::filesystem;

/// A line's end in a comment of case_as_run.yaml would begin a line of the case.
void check_path(const fs::path& path) {
  const auto is_control = [](unsigned char c) { return c < ' ' || c == 0x7F; };
  std::string whole = place_of(path).string();
  if (!is_utf8(whole)) throw input_error("{}: its path is not UTF-8, as results must be, which name it", path.string());
  if (std::none_of(whole.begin(), whole.end(), is_control)) return;
  std::replace_if(whole.begin(), whole.end(), is_control, '?');
  throw input_error("{}: its path holds control characters (an end of line, a tab; here ?): rename the file or folder",
                    whole);
}

fs::path named_path(const fs::path& folder, const fs::path& name) {
  const fs::path named = folder / name, plain = named.lexically_normal();
  std::error_code none;
  if (!fs::exists(named, none)) return named;
  check_path(named);
  return fs::equivalent(named, plain, none) ? plain : place_of(named);
}

/// The file's own name tells its kind.
fs::path place_of(const fs::path& file) {
  std::error_code none;
  const fs::path whole = fs::absolute(file), folder = fs::weakly_canonical(whole.parent_path(), none);
  return ((folder.empty() ? whole.parent_path() : folder) / whole.filename()).lexically_normal();
}

std::string name_for(const fs::path& file, const fs::path& folder) {
  return place_of(file).lexically_proximate(place_of(folder / "")).string();
}

}  // namespace tether
