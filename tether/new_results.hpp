#pragma once

#include <filesystem>
#include <vector>

namespace tether {

/// New results beside the old ones of a folder, which stay as they are until all new ones are written.
class NewResults {
 public:
  /// names: of files in the folder, in the order in which new ones take their places.
  NewResults(std::filesystem::path folder, std::vector<std::filesystem::path> names);
  ~NewResults();  ///< what is still beside goes
  NewResults(const NewResults&) = delete;
  NewResults& operator=(const NewResults&) = delete;

  /// Where the new one of this name, or folder of such, is to be written: "model/case.yaml" in ".new_model".
  std::filesystem::path beside(const std::filesystem::path& name) const;
  /// Notes what new files to go on with will hold (note_coming); before the old ones go. Throws RunError if one of the
  /// old ones was changed meanwhile.
  void note(const std::vector<std::filesystem::path>& to_go_on_with) const;
  /// Of a name that is not written anew the old one goes.
  void put_in_place() const;

 private:
  void remove() const;

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> names_;
};

}  // namespace tether
