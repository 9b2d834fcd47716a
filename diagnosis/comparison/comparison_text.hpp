#pragma once

#include "diagnosis/comparison/comparison.hpp"

namespace tether {

/// What a comparison tells a person: the sentences, and for each source a table of its regions over all frames, the
/// data's own motion beside it, held-out frames apart.
std::string text_of(const Comparison& comparison);

}  // namespace tether
