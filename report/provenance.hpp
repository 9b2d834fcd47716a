#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tether {

/// A case as it was run: the files that it names, the seeds of its random numbers.
struct CaseInputs {
  struct File {
    std::string field, name,
        modified;  ///< "observations.contours.cine_mr.file"; as the case has it; "2026-01-31 12:00"
    std::uintmax_t bytes = 0;
    std::string content;  ///< a hash of what it holds, as records have it
    std::filesystem::path path;
  };
  struct Seed {
    std::string field, value;
  };
  std::vector<File> files;
  std::vector<Seed> seeds;
};

/// Throws InputError if the case cannot be read.
CaseInputs inputs_of(const std::filesystem::path& case_file);

/// When a file was written, "2026-01-31 12:00 UTC"; empty if there is none.
std::string date_of(const std::filesystem::path& file);
/// The date of this moment.
std::string date_now();

/// Whether a file was written, or put in its place, after another one: by the time of change, which no program sets.
bool came_after(const std::filesystem::path& file, const std::filesystem::path& result);

/// The case file whose results a folder holds, as the folder's mark says; nothing if it does not say or it is gone.
std::optional<std::filesystem::path> case_of_results(const std::filesystem::path& folder);

/// The version of these sources: "0.1.0", and the commit that this program was built from, if known.
std::string version();
std::string commit();

}  // namespace tether
