#pragma once

#include "common/config/command_line.hpp"

namespace tether {

/// The program fsi_master: reads the case, launches fluid and solid, simulates, writes the summary.
Program fsi_master_program();

}  // namespace tether
