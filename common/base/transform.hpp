#pragma once

#include <string>

#include "common/base/effect.hpp"

namespace tether {

/// theta of a value under a transform: itself, its logarithm (natural, or to base 2), or for `bounded` the logit of its
/// place in `range`. (K.1) Throws InputError for a value that has none.
double stretched(Transform transform, double value, const Range& range);

/// The value of a theta: the inverse of `stretched`.
double unstretched(Transform transform, double theta, const Range& range);

/// By its name in a case or a message. Throws InputError that lists the known ones.
Transform transform_named(const std::string& name);

}  // namespace tether
