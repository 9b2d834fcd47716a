#pragma once

#include "diagnosis/explanation/path.hpp"

namespace tether {

/// The verdict first, then what a person should know next, a sentence each.
std::vector<std::string> sentences_of(const ExplanationPath& path);

}  // namespace tether
