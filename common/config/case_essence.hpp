#pragma once

#include <cstdint>
#include <string>

namespace tether {

/// Names an effective case (JSON) by a hash. What may change between a run and its continuation does not count: folders
/// of files, title, the end of the run, output, coupling. A text that is no JSON counts as it is.
std::uint64_t hash_case(const std::string& effective_case, std::uint64_t seed);

}  // namespace tether
