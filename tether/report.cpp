#include "report/report.hpp"

#include "common/base/error.hpp"
#include "tether/verbs.hpp"

namespace tether {

Made<std::filesystem::path> report(const CommandLine& command) {
  const std::filesystem::path folder = command.case_file;
  if (!std::filesystem::is_directory(folder))
    throw input_error(
        "{}: is not a folder of results; give that of tether explain, compare, diagnose, identify or simulate",
        folder.string());
  std::filesystem::path page = write_report(folder);
  std::string told = page.string() + "\n";
  return {std::move(page), std::move(told)};
}

}  // namespace tether
