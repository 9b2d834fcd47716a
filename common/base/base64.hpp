#pragma once

#include <cstddef>
#include <string>

namespace tether {

/// Bytes as text of A-Z a-z 0-9 + / (RFC 4648).
std::string base64(const void* bytes, std::size_t count);

/// Back to bytes: of the letters before the first character that is none.
std::string from_base64(const std::string& text);

}  // namespace tether
