#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <map>

namespace tether {

/// The files of a case as they stood when this was made. Programs read them when they start, each for itself; results
/// are of what they hold, which must have been the same for all.
class InputWatch {
 public:
  explicit InputWatch(const std::filesystem::path& case_file);
  /// Throws RunError that names the first file which was written since, or is another one; also if it now holds the
  /// same again: what it held when it was read is not known.
  void check() const;

 private:
  struct Stamp {
    std::uint64_t inode = 0;
    std::int64_t size = 0, changed = 0;  ///< [bytes], [ns]
    auto operator<=>(const Stamp&) const = default;
  };
  static Stamp stamp_of(const std::filesystem::path& file);

  std::map<std::filesystem::path, Stamp> stamps_;
};

}  // namespace tether
