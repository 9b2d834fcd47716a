#pragma once

#include "common/config/command_line.hpp"

namespace tether {

/// The program observation_manager: reads the measurements of a case, answers how far the moving lumen is from them.
Program observation_program();

}  // namespace tether
