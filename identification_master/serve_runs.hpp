#pragma once

#include <filesystem>

#include "common/config/command_line.hpp"
#include "common/protocol/launch.hpp"

namespace tether {

/// Makes runs of the command's case for the process that listens at `socket`, until that stops it or ends: then this
/// process and all that it started end too. Throws InputError for a wrong case.
void serve_runs(const CommandLine& command, const std::filesystem::path& socket, protocol::Session& session);

}  // namespace tether
