#pragma once

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "common/config/yaml_tree.hpp"

/// What the files that a case names hold. Results are kept as long as that is the same: names and dates tell nothing.
namespace tether {

/// A hash of what a file holds, and of what the files hold that a table (.csv) or series (.pvd) names; of a folder: of
/// the names and contents of the files in it and in its folders. The hash of nothing if there is no such file.
std::uint64_t hash_content(const std::filesystem::path& path);

/// The files that a table (.csv) or series (.pvd) names, as far as its text shows them; none of other files. Who reads
/// such a list refuses a name that is not among them: what that file holds would not count.
std::set<std::filesystem::path> files_named_in(const std::filesystem::path& list);

/// A file or folder that a value of a case names.
struct InputFile {
  std::string field;  ///< "observations.surfaces.ct.file"; of an item of a list, that of the list
  std::string name;   ///< as the case has it
  std::uint64_t content = 0;
};

/// All of them, in the order of the case; of a run that `initial_state` names the state that it saved last. A word that
/// happens to be the name of a file beside the case counts as one: what a program of somebody else reads is not known
/// here.
std::vector<InputFile> input_files(const std::filesystem::path& case_file);

/// Of the files of `observations` what each holds, as hexadecimal digits: what results were made of.
std::vector<std::string> data_hashes(const std::filesystem::path& case_file);

/// The files that a case is read from: its own, those that it builds on, those of `input_files` and those that tables
/// and series among them name; of a folder the meshes in it and in its folders, but not those of results.
std::set<std::filesystem::path> files_read(const std::filesystem::path& case_file);

/// The folders that it reads a mesh, surfaces or an earlier run's state from.
std::set<std::filesystem::path> folders_read(const std::filesystem::path& case_file);

/// A hash of what all of the files hold; 0 if the case cannot be read.
std::uint64_t hash_files_read(const std::filesystem::path& case_file);

/// Names an effective case (JSON) by a hash. Texts that begin with '/' are files: what they hold counts (hash_content),
/// and their folders do not. Nor does what may change between a run and its continuation: title, the end of the run,
/// output, coupling. A text that is no JSON counts as it is.
std::uint64_t hash_case(const std::string& effective_case, std::uint64_t seed);

}  // namespace tether
