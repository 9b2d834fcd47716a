#include "common/base/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <map>
#include <optional>
#include <thread>

#include "common/base/error.hpp"
#include "common/base/process.hpp"
#include "common/base/write_error.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

/// With programs of a holder that was killed, no orphan lives longer; with one that may just be ending.
constexpr std::chrono::seconds patience_with_orphans{10}, patience{2};
constexpr std::chrono::milliseconds look_every{50};

struct Holder {
  std::string host;
  std::int64_t pid = 0;
  bool is_here() const { return host == host_name(); }
  bool is_dead() const { return is_here() && !is_running(pid); }
  std::string name() const { return fmt::format("{}:{}", host, pid); }
};

Holder read_holder(int file) {
  std::array<char, 512> text{};
  const ssize_t count = pread(file, text.data(), text.size() - 1, 0);
  const std::string_view name(text.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  const auto colon = name.rfind(':');
  if (colon == std::string_view::npos) return {};
  return {std::string(name.substr(0, colon)), std::atoll(text.data() + colon + 1)};
}

void write_holder(int file, const fs::path& folder) {
  const std::string text = holder_name() + "\n";
  if (ftruncate(file, 0) != 0 || pwrite(file, text.data(), text.size(), 0) < 0)
    refuse_folder(folder, "cannot be written to", errno);
}

enum class Lock { ours, taken, impossible };

Lock try_lock(int file) {
  if (flock(file, LOCK_EX | LOCK_NB) == 0) return Lock::ours;
  return errno == EWOULDBLOCK ? Lock::taken : Lock::impossible;
}

bool is_from(const Holder& holder) {
  const char* name = std::getenv(holder_variable);
  return name != nullptr && holder.name() == name;
}

Lock wait_for_lock(int file) {
  const auto begin = std::chrono::steady_clock::now();
  for (;; std::this_thread::sleep_for(look_every)) {
    const Lock lock = try_lock(file);
    const Holder other = read_holder(file);
    if (lock != Lock::taken || is_from(other)) return lock;
    if (std::chrono::steady_clock::now() - begin > (other.is_dead() ? patience_with_orphans : patience)) return lock;
  }
}

/// Device and number of a file; nothing if it is not there.
using Identity = std::optional<std::pair<dev_t, ino_t>>;

Identity identity_of(const fs::path& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return std::nullopt;
  return std::pair(found.st_dev, found.st_ino);
}

/// The lock of each folder that is held, or used beside its holder.
std::map<fs::path, Identity>& held() {
  static std::map<fs::path, Identity> all;
  return all;
}

}  // namespace

std::string holder_name() {
  return fmt::format("{}:{}", host_name(), process_id());
}

/// The file stays open, also in the programs that this process starts: the last of them frees the folder.
void hold_folder(const fs::path& folder) {
  const fs::path path = fs::canonical(folder) / folder_lock_name;
  if (held().contains(path)) return;
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK, 0666);
  if (file < 0) refuse_folder(folder, "cannot be written to", errno);
  const Lock lock = wait_for_lock(file);
  const Holder other = read_holder(file);
  if (lock == Lock::taken && !is_from(other)) {
    close(file);
    throw input_error(
        "{}: another run is writing to this folder: process {}{}; wait for it, end it, or choose another folder with "
        "--output",
        folder.string(), other.pid, other.is_here() ? "" : " on " + other.host);
  }
  if (lock == Lock::ours) write_holder(file, folder);
  held()[path] = identity_of(path);
}

void check_held(const fs::path& folder) {
  const auto found = held().find(fs::weakly_canonical(folder) / folder_lock_name);
  if (found != held().end() && identity_of(found->first) != found->second)
    throw run_error("{}: was removed during the run, or another run has taken it", folder.string());
}

void check_all_held() {
  for (const auto& [lock, identity] : held()) check_held(lock.parent_path());
}

}  // namespace tether
