#include "report/report.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "common/base/error.hpp"
#include "common/base/write_error.hpp"
#include "common/config/output_folder.hpp"
#include "report/collect.hpp"
#include "report/page.hpp"

namespace tether {

std::filesystem::path write_report(const std::filesystem::path& folder) {
  check_writable_through(folder);
  const std::string document = collected(folder);
  const auto title = nlohmann::json::parse(document)["title"].get<std::string>();
  const std::filesystem::path path = folder / "report.html";
  const std::string page = page_of(title, document);
  std::ofstream file(path, std::ios::binary);
  file << page << std::flush;
  if (!file) throw write_error(path);
  return path;
}

}  // namespace tether
