#pragma once

#include "common/config/command_line.hpp"

namespace tether {

/// The program solid: reads the case, answers an fsi_master.
Program solid_program();

}  // namespace tether
