#pragma once

#include "common/config/command_line.hpp"
#include "common/protocol/launch.hpp"

namespace tether::fluid {

/// The program fluid: reads the case, answers an fsi_master.
Program fluid_program();

/// The same code as a part of the process that asks it.
protocol::Here fluid_here();

}  // namespace tether::fluid
