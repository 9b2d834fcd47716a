#pragma once

#include <span>
#include <string>

#include "common/config/case.hpp"
#include "common/protocol/partner.hpp"
#include "fsi_master/coupled_codes.hpp"

/// What a run depends on that its codes need not tell.
namespace tether {

/// Of codes of somebody else, as JSON, each a hash: all that the case says which they may read and what the files named
/// there hold, what their programs hold (if the case names them) and call themselves. What a program loads beside
/// itself (modules, libraries) is not known. processes: fluid and solid, which have said hello.
std::string untold_json(const MasterCase& master, std::span<protocol::Partner> processes);

/// Where points are followed, as JSON: another place under the same name makes another column.
std::string followed_json(const OutputCase& output);

}  // namespace tether
