#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tether {

/// The header of an image that is text: fields of a name and a value, which the formats separate in different ways.
class TextHeader {
 public:
  TextHeader(const std::filesystem::path& file, std::size_t longest_line)
      : file_(file.string()), longest_line_(longest_line), in_(file, std::ios::binary) {}

  /// The next line without its end; none behind the last one. Throws InputError if it is no text or too long, or they
  /// are more than any image's.
  std::optional<std::string> next();
  /// Throws InputError if it is given twice.
  void add(const std::string& name, const std::string& value);

  bool has(const std::string& name) const { return fields_.contains(name); }
  std::string get(const std::string& name) const;
  /// Throws InputError for what is no number from `least` to `most`.
  std::uint64_t count(const std::string& name, std::uint64_t least, std::uint64_t most) const;
  std::vector<std::uint64_t> counts(const std::string& name, std::uint64_t least, std::uint64_t most) const;
  /// As lengths_of. Throws InputError where there are none.
  std::vector<double> lengths(const std::string& name, bool may_be_nan = false) const;
  /// Where the bytes behind the lines that were read begin.
  std::uint64_t end();

  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void refuse(const std::string& name, const std::string& rule) const;

 private:
  std::string file_;
  std::size_t longest_line_;
  std::ifstream in_;
  int line_ = 0;
  std::size_t bytes_ = 0;  ///< of the lines so far
  std::map<std::string, std::string> fields_;
};

/// Whether images have such places, axes and spacings: ITK aborts on what is not finite, and decomposes without end
/// what has numbers below all others.
bool is_length(double number);

/// Numbers between blanks, commas and brackets; none unless each is a length, or nan where it may be.
std::optional<std::vector<double>> lengths_of(std::string text, bool may_be_nan = false);

/// Without blanks around it.
std::string trimmed(const std::string& text);

}  // namespace tether
