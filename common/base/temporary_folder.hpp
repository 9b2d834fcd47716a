#pragma once

#include <filesystem>
#include <string>

namespace tether {

/// Where files stand that end with their process: TMPDIR, or /tmp. Throws InputError if there is no such folder.
std::filesystem::path temporary_folder();

/// A folder of its own in there that ends with this object.
class ScratchFolder {
 public:
  /// Throws a write error.
  explicit ScratchFolder(const std::string& name);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace tether
