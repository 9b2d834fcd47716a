#pragma once

#include <cstdint>
#include <string>

namespace tether {

/// Names an effective case (JSON) by a hash. Texts that begin with '/' are files: what they hold counts (hash_content),
/// and their folders do not. Nor does what may change between a run and its continuation: title, the end of the run,
/// output, coupling. A text that is no JSON counts as it is.
std::uint64_t hash_case(const std::string& effective_case, std::uint64_t seed);

}  // namespace tether
