#pragma once

#include <string>
#include <string_view>

namespace tether {

/// A text as messages quote it: a long one without its middle, in about so many bytes. Characters stay whole.
std::string shortened(std::string_view text, std::size_t most = 60);

}  // namespace tether
