#include "report/report.hpp"

#include <iostream>

#include "common/base/error.hpp"
#include "tether/verbs.hpp"

namespace tether {

int report(const CommandLine& command) {
  const std::filesystem::path folder = command.case_file;
  if (!std::filesystem::is_directory(folder))
    throw input_error("{}: is not a folder of results; give that of tether explain, compare, diagnose or identify",
                      folder.string());
  const std::filesystem::path page = write_report(folder);
  if (!command.quiet) std::cout << page.string() << "\n";
  return exit_done;
}

}  // namespace tether
