#pragma once

#include "common/config/yaml_tree.hpp"

/// Case files that build on another one: `base: ../tube/case.yaml`.
namespace tether {

/// A case file merged with the one it builds on, and so on down to one without `base`. Sections are merged; what a file
/// says wins over its base; an entry without a value removes the base's. Every value keeps the place it stands at.
/// Throws InputError "file:line: ...".
YamlNode read_case_tree(const std::filesystem::path& file);

/// The files of a case, itself first.
std::vector<std::filesystem::path> files_of_case(const std::filesystem::path& file);

/// The tree of a case with `base`, as one file in the case's own folder would say it: values that name a file beside a
/// base are written relative to the case. Of a case without `base`, the same tree.
YamlNode as_one_file(YamlNode tree);

/// The case as one file: as it stands, or merged with what it builds on.
std::string case_text(const std::filesystem::path& file);

}  // namespace tether
