#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

/// The readers of all that comes from outside, given any bytes.
namespace tether::fuzz {

struct Input {
  std::string_view name;  ///< the reader's: the ending of the file
  std::string bytes;
  /// A file that holds them.
  std::filesystem::path file() const;
};

struct FuzzedReader {
  std::string_view name;  ///< also of its folders in seeds/ and findings/
  void (*read)(const Input& input);
};

std::span<const FuzzedReader> readers();

/// Gives bytes to a reader. Its own refusal, an InputError, ends here; whatever else is thrown is a finding.
void read_any(const FuzzedReader& reader, const std::string& bytes);

}  // namespace tether::fuzz
