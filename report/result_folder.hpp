#pragma once

#include <filesystem>
#include <string>

namespace tether {

/// The folder whose page is made. A page is mailed: it shows what stands in its folder, and nothing that a link, or a
/// record that was written by somebody else, leads to elsewhere.
class ResultFolder {
 public:
  explicit ResultFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& path() const { return folder_; }
  bool holds(const std::filesystem::path& path) const;
  /// Throws InputError if the path leads out of the folder.
  void check_holds(const std::filesystem::path& path) const;
  /// Throws InputError that names the record and its field if what it names is elsewhere.
  void check_names(const std::string& name, const std::string& record, const std::string& field) const;
  /// A text or a picture for the page. Throws InputError for what is elsewhere, no file, or too large to be mailed.
  std::string content(const std::filesystem::path& file) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace tether
