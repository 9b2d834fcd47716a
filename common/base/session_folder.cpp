#include "common/base/session_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>

namespace tether {
namespace {

namespace fs = std::filesystem;

/// Of one that is younger the lock may not be taken yet.
constexpr std::chrono::minutes young{1};

/// Its descriptor; -1 if another process holds it, or it is not this person's.
int locked(const fs::path& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0 || flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  close(descriptor);
  return -1;
}

void remove_left_ones(const std::string& name) {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(temporary_folder(), none)) {
    if (!entry.path().filename().string().starts_with(name + "_")) continue;
    const auto made = fs::last_write_time(entry.path(), none);
    if (none || fs::file_time_type::clock::now() - made < young) continue;
    const int lock = locked(entry.path());
    if (lock < 0) continue;
    fs::remove_all(entry.path(), none);
    close(lock);
  }
}

}  // namespace

SessionFolder::SessionFolder(const std::string& name) : folder_(name), lock_(locked(folder_.path())) {
  remove_left_ones(name);
}

SessionFolder::~SessionFolder() {
  if (lock_ >= 0) close(lock_);
}

}  // namespace tether
