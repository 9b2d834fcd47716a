#pragma once

#include <vector>

#include "common/base/error.hpp"
#include "common/base/types.hpp"

namespace tether {

/// An input that is wrong at places that can be shown.
struct PlacedError : InputError {
  PlacedError(const std::string& message, std::vector<Vec3> at) : InputError(message), places(std::move(at)) {}
  std::vector<Vec3> places;  ///< [length]
};

}  // namespace tether
