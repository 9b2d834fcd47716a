#include "report/result_folder.hpp"

#include "common/base/error.hpp"
#include "common/base/input_stream.hpp"

namespace tether {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_part = 16'000'000;  ///< of a page that is mailed; a plot has 0.1 MB

bool ResultFolder::holds(const fs::path& path) const {
  std::error_code lost, lost_too;
  const fs::path place = fs::weakly_canonical(path, lost), root = fs::canonical(folder_, lost_too);
  if (lost || lost_too) return false;
  const fs::path from_it = place.lexically_relative(root);
  return !from_it.empty() && *from_it.begin() != "..";
}

void ResultFolder::check_holds(const fs::path& path) const {
  if (!holds(path))
    throw input_error("{}: leads out of {}: a page shows what stands in its folder", path.string(), folder_.string());
}

void ResultFolder::check_names(const std::string& name, const std::string& record, const std::string& field) const {
  if (!holds(folder_ / name))
    throw input_error("{}: {}: {}: must name what stands in this folder", (folder_ / record).string(), field, name);
}

std::string ResultFolder::content(const fs::path& file) const {
  check_holds(file);
  return content_of(file, largest_part);
}

}  // namespace tether
