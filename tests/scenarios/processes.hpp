#pragma once

#include <filesystem>
#include <fstream>
#include <string>

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

}  // namespace tether
