#pragma once

#include "common/config/command_line.hpp"

namespace tether {

/// Checks the case, runs it, draws plots and says where to look. Returns the run's exit code.
int simulate(const CommandLine& command);

/// Sets a finished run of the case against its measurements: comparison.json and .csv, drawings, a summary. Simulates
/// first if there is no such run. Returns the run's exit code.
int compare(const CommandLine& command);

/// Checks the case with every program that reads it. Throws InputError with all that they find.
void check_case(const CommandLine& command);
int validate(const CommandLine& command);

/// Writes OUTPUT/mesh/fluid.vtu, wall.vtu and their faces, and tells sizes and quality.
int write_meshes(const CommandLine& command);

/// The reference of the whole case file, gathered from the programs that read it. `format`: text or markdown.
std::string case_reference(const std::string& format);

}  // namespace tether
