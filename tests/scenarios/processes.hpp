#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace tether {

/// The process of a program that works on a case; 0 if there is none.
inline pid_t process_of(const std::string& program, const std::filesystem::path& case_file) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream file(entry.path() / "cmdline", std::ios::binary);
    std::string line;
    std::getline(file, line);  // not through an iterator, which throws for a process that has just ended
    const std::string executable = line.substr(0, line.find('\0'));
    if (std::filesystem::path(executable).filename() == program && line.find(case_file.string()) != std::string::npos)
      return std::stoi(entry.path().filename());
  }
  return 0;
}

/// What of these programs still works on one of these cases after a minute; empty if all end sooner. Three looks in a
/// row must find none: one that forks or becomes another program has no command line for a moment.
inline std::string orphan_of(const std::vector<std::string>& programs,
                             const std::vector<std::filesystem::path>& case_files) {
  std::string found;
  for (int look = 0, none = 0; look < 600 && none < 3; ++look) {
    found.clear();
    for (const std::string& program : programs)
      for (const auto& of : case_files)
        if (process_of(program, of) != 0) found = program + " of " + of.string();
    none = found.empty() ? none + 1 : 0;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return found;
}

}  // namespace tether
