#include "common/config/output_folder.hpp"

#include <fstream>

#include "common/base/error.hpp"
#include "common/config/case_tree.hpp"

namespace tether {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view copy_of = "# Copy of ", as_it_was = " as it was";
constexpr const char* way_out = "choose another folder with --output, or give --overwrite";

/// Throws InputError if the folder holds anything but results of this very case file.
void check_owner(const fs::path& folder, const std::string& name, const fs::path& case_file) {
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder)) throw input_error("{}: is not a folder", folder.string());
  if (!fs::exists(folder / case_as_run)) {
    if (fs::is_empty(folder)) return;
    throw input_error("{}: holds files that are not the results of a run; {}", folder.string(), way_out);
  }
  const YamlNode marker = read_yaml(folder / case_as_run);
  const YamlNode* owner = marker.find("name");
  std::ifstream copy(folder / case_as_run);
  std::string first;
  std::getline(copy, first);
  const bool same_file =
      first.find(" " + fs::absolute(case_file).lexically_normal().string() + " ") != std::string::npos;
  if (owner && owner->text == name && same_file) return;
  if (owner && owner->text == name)
    throw input_error("{}: holds the results of another case file of the name '{}'{}; {}", folder.string(), name,
                      first.starts_with(copy_of)
                          ? " (" + first.substr(copy_of.size(), first.find(as_it_was) - copy_of.size()) + ")"
                          : "",
                      way_out);
  throw input_error("{}: holds the results of the case '{}'; {}", folder.string(), owner ? owner->text : "?", way_out);
}

/// The case as one file: as it stands, or merged with what it builds on.
void copy_case(const fs::path& case_file, const std::vector<fs::path>& files, std::ostream& to) {
  if (files.size() == 1) {
    to << std::ifstream(case_file).rdbuf();
    return;
  }
  for (std::size_t i = 1; i < files.size(); ++i)
    to << "# Merged with " << fs::absolute(files[i]).lexically_normal().string() << "\n";
  to << yaml_text(as_one_file(read_case_tree(case_file)));
}

void mark(const fs::path& folder, const fs::path& case_file) {
  std::ofstream to(folder / case_as_run);
  to << copy_of << fs::absolute(case_file).lexically_normal().string() << as_it_was
     << " when the run started. Its paths are relative to that file.\n";
  copy_case(case_file, files_of_case(case_file), to);
  if (!to) throw input_error("{}: cannot be written to", folder.string());
}

}  // namespace

fs::path output_of(const CommandLine& command, const CaseFile& file) {
  return command.output.empty() ? fs::path("out") / file.common().name : command.output;
}

fs::path claim_output(const CommandLine& command, const CaseFile& file) {
  const std::string& name = file.common().name;
  const fs::path folder = output_of(command, file);
  if (!command.overwrite) check_owner(folder, name, file.path());
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw input_error("{}: cannot be made: {}", folder.string(), error.message());
  mark(folder, file.path());
  return folder;
}

}  // namespace tether
