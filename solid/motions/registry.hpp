#pragma once

#include <span>

#include "common/base/effect.hpp"
#include "solid/motions/motion.hpp"

namespace tether {

extern const Registered<MotionLaw> breathing, measured_motion, moving_tissue;

/// All motions of tissue. A new one: one file, one name above, one name in registry.cpp.
std::span<const Registered<MotionLaw>> motions();

}  // namespace tether
