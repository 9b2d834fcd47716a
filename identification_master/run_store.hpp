#pragma once

#include <filesystem>
#include <optional>

#include "identification_master/results/made_run.hpp"

namespace tether {

/// What a folder holds; nothing if no run ended there that this version understands, or what it left is damaged.
std::optional<MadeRun> made_run_in(const std::filesystem::path& folder);

/// Writes that record.
void write_made_run(const std::filesystem::path& folder, MadeRun run);

/// A folder of runs that several diagnoses share, each under a name that is made of all it depends on. A run comes in
/// as a whole (one rename) and is not changed from then on, so that any number of processes may use the folder at once;
/// two that make the same run keep the first. Who wants a run has a link to it in the place where it would be.
class RunStore {
 public:
  /// Shares nothing.
  RunStore() = default;
  /// depends_on: what runs depend on beside what MadeRun says. Throws InputError if there can be no such folder.
  RunStore(std::filesystem::path folder, std::string depends_on);

  /// Makes `folder` a link to a run, if it is here.
  std::optional<MadeRun> lend(const MadeRun& wanted, const std::filesystem::path& folder) const;
  /// Takes a run that came to its end in `folder`, and lends it in that place.
  void take(const MadeRun& made, const std::filesystem::path& folder) const;

 private:
  std::filesystem::path place_of(const MadeRun& run) const;

  std::filesystem::path folder_;  ///< empty: none
  std::string depends_on_;
};

}  // namespace tether
