#pragma once

#include <string>

namespace tether {

/// For the shell: 'it'\''s'.
std::string shell_quoted(const std::string& text);

}  // namespace tether
