#pragma once

#include <map>
#include <string>

#include "common/config/command_line.hpp"
#include "common/protocol/launch.hpp"

namespace tether {

/// Codes that a program brings with it, by the name of the program that each is otherwise.
using CodesHere = std::map<std::string, protocol::Here>;

/// The program fsi_master: reads the case, launches fluid and solid, simulates, writes the summary. As a group of an
/// identification_master, or where the case says so, it has the codes that are here in its own process.
Program fsi_master_program(const CodesHere& here = {});

}  // namespace tether
