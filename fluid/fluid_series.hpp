#pragma once

#include <filesystem>
#include <optional>

#include "common/io/pvd.hpp"
#include "fluid/fluid_solver.hpp"

namespace tether::fluid {

/// fluid.pvd and the files it lists: velocity, pressure (relative to the image's) and displacement of the mesh at its
/// nodes, on the imaged positions.
class FluidSeries {
 public:
  explicit FluidSeries(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Entries at this time or later, left by a run that was stopped, give way.
  void write(const FluidSolver& solver, int step, double time);

 private:
  std::filesystem::path folder_;
  std::optional<PvdSeries> series_;
};

}  // namespace tether::fluid
