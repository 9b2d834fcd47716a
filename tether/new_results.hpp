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

  /// Where the new one of this name is to be written.
  std::filesystem::path beside(const std::filesystem::path& name) const;
  /// Of a name that is not written anew the old one goes.
  void put_in_place() const;

 private:
  void remove() const;

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> names_;
};

/// note_made of files to go on with that were just made. Where that cannot be they go, lest they be taken for a
/// person's: the same command makes them again.
void note_just_made(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& files);

}  // namespace tether
