#pragma once

#include "common/config/command_line.hpp"
#include "common/protocol/launch.hpp"

namespace tether {

/// The program solid: reads the case, answers an fsi_master.
Program solid_program();

/// The same code as a part of the process that asks it.
protocol::Here solid_here();

}  // namespace tether
