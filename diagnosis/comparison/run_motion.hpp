#pragma once

#include <filesystem>

#include "observation_manager/measurements/measured_run.hpp"

namespace tether {

/// Of a finished run, from lumen.motion in its folder. Throws InputError if there is none.
RunMotion stored_motion(const std::filesystem::path& folder);

}  // namespace tether
