#pragma once

#include <string>

namespace tether {

/// Of a word or an extension in ASCII: programs write .STL too.
std::string lower_case(std::string text);

}  // namespace tether
