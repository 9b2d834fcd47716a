#include "tests/scenarios/case_variant.hpp"

#include <fstream>
#include <sstream>

#include "common/base/error.hpp"

namespace tether {

namespace fs = std::filesystem;

fs::path case_variant(const fs::path& case_file, const fs::path& folder, const Edits& edits) {
  std::string text = content_of(case_file);
  for (const auto& [piece, replacement] : edits) {
    std::size_t place = text.find(piece);
    if (place == std::string::npos) throw run_error("{}: holds no '{}'", case_file.string(), piece);
    for (; place != std::string::npos; place = text.find(piece, place + replacement.size()))
      text.replace(place, piece.size(), replacement);
  }
  fs::remove_all(folder);
  fs::create_directories(folder.parent_path());
  fs::copy(case_file.parent_path(), folder, fs::copy_options::recursive);
  const fs::path result = folder / case_file.filename();
  std::ofstream(result) << text;
  return result;
}

std::string content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw run_error("{}: cannot be read", file.string());
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace tether
