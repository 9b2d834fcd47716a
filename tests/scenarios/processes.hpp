#pragma once

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

namespace tether {

/// The processes of a program that work on a case, ascending.
inline std::vector<pid_t> processes_of(const std::string& program, const std::filesystem::path& case_file) {
  std::vector<pid_t> all;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream file(entry.path() / "cmdline", std::ios::binary);
    std::string line;
    std::getline(file, line);  // not through an iterator, which throws for a process that has just ended
    const std::string executable = line.substr(0, line.find('\0'));
    if (std::filesystem::path(executable).filename() == program && line.find(case_file.string()) != std::string::npos)
      all.push_back(std::stoi(entry.path().filename()));
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// The first of them; 0 if there is none.
inline pid_t process_of(const std::string& program, const std::filesystem::path& case_file) {
  const std::vector<pid_t> all = processes_of(program, case_file);
  return all.empty() ? 0 : all.front();
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
