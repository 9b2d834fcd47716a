#pragma once

#include "common/base/temporary_folder.hpp"

namespace tether {

/// A folder in TMPDIR for what other programs leave there as long as this object lives. What such folders of processes
/// that were killed still hold goes when the next one is made.
class SessionFolder {
 public:
  /// Throws a write error.
  explicit SessionFolder(const std::string& name);
  ~SessionFolder();
  SessionFolder(const SessionFolder&) = delete;
  SessionFolder& operator=(const SessionFolder&) = delete;
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  ScratchFolder folder_;
  int lock_;  ///< descriptor: nobody else removes the folder while it is held, whatever becomes of process numbers
};

}  // namespace tether
