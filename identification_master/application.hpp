#pragma once

#include "common/config/command_line.hpp"

namespace tether {

/// The program that finds parameters: p + 1 particles on groups of fsi_masters, corrected at every step.
Program identification_master_program();

}  // namespace tether
