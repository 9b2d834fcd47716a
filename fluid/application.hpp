#pragma once

#include "common/config/command_line.hpp"

namespace tether::fluid {

/// The program fluid: reads the case, answers an fsi_master.
Program fluid_program();

}  // namespace tether::fluid
