#pragma once

#include "observation_manager/measurements/observation_case.hpp"

namespace tether {

/// Velocities at points of space, as phase-contrast MR measures them on planes.
struct VelocitiesCase {
  std::filesystem::path file;
  std::string components = "vector";
  Vec3 direction = Vec3::Constant(undefined);
  std::optional<double> beat, period;
  double time_shift = 0;
  std::vector<double> held_out;
  NoiseCase noise{dimension::velocity};
  void declare(Fields& f);
};

}  // namespace tether
