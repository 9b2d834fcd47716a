#include "common/config/named_path.hpp"

namespace tether {

namespace fs = std::filesystem;

fs::path named_path(const fs::path& folder, const fs::path& name) {
  const fs::path named = folder / name, plain = named.lexically_normal();
  std::error_code none;
  if (!fs::exists(named, none)) return named;
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
