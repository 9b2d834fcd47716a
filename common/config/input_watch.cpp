#include "common/config/input_watch.hpp"

#include <sys/stat.h>

#include "common/base/error.hpp"
#include "common/config/input_files.hpp"

namespace tether {

namespace fs = std::filesystem;

InputWatch::InputWatch(const fs::path& case_file) {
  for (const fs::path& file : files_read(case_file)) stamps_.emplace(file, stamp_of(file));
}

void InputWatch::check() const {
  for (const auto& [file, stamp] : stamps_)
    if (stamp_of(file) != stamp)
      throw run_error("{}: was written during the run, which may have read it before and after: start it again",
                      file.lexically_normal().string());
}

/// Zeros if there is no such file. The time is that of the last change of any kind: a program can set the other one.
InputWatch::Stamp InputWatch::stamp_of(const fs::path& file) {
  struct stat found {};
  if (stat(file.c_str(), &found) != 0) return {};
  return {found.st_ino, found.st_size, 1'000'000'000 * found.st_ctim.tv_sec + found.st_ctim.tv_nsec};
}

}  // namespace tether
