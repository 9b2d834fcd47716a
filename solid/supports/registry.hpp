#pragma once

#include <span>

#include "common/base/effect.hpp"
#include "solid/supports/support.hpp"

namespace tether {

extern const Registered<Support> visco_elastic, normal_visco_elastic, tangential_visco_elastic;

/// All supports. A new one: one file, one name above, one name in registry.cpp.
std::span<const Registered<Support>> supports();

}  // namespace tether
