#include "common/config/named_path.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// Without links, but for the file itself, whose name tells its kind.
fs::path without_links(const fs::path& path) {
  std::error_code none;
  const fs::path whole = fs::absolute(path), folder = fs::weakly_canonical(whole.parent_path(), none);
  return ((folder.empty() ? whole.parent_path() : folder) / whole.filename()).lexically_normal();
}

}  // namespace

fs::path named_path(const fs::path& folder, const fs::path& name) {
  const fs::path named = folder / name, plain = named.lexically_normal();
  std::error_code none;
  if (!fs::exists(named, none)) return named;
  return fs::equivalent(named, plain, none) ? plain : without_links(named);
}

std::string name_for(const fs::path& file, const fs::path& folder) {
  return without_links(file).lexically_proximate(without_links(folder / "")).string();
}

}  // namespace tether
