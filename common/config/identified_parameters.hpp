#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tether {

/// A parameter that a case identifies, and the numbers of the model that it sets.
struct IdentifiedParameter {
  std::string name;
  std::vector<std::string> of;
};

/// Of the section `identification` of a case or of what it builds on; none without. Throws InputError for files that
/// cannot be read.
std::vector<IdentifiedParameter> identified_parameters(const std::filesystem::path& case_file);

}  // namespace tether
