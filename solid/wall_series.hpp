#pragma once

#include <filesystem>
#include <optional>

#include "common/io/pvd.hpp"
#include "solid/solid_solver.hpp"

namespace tether {

/// solid.pvd and the files it lists: displacement [length], velocity, Cauchy stress with its von Mises and hoop-like
/// largest principal value [pressure], on the imaged positions.
class WallSeries {
 public:
  explicit WallSeries(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// `stress`: Cauchy's, of each element. Entries at this time or later, left by a run that was stopped, give way.
  void write(const WallModel& model, const SolidSolver& solver, const Eigen::Matrix<double, 6, Eigen::Dynamic>& stress,
             int step, double time);

 private:
  std::filesystem::path folder_;
  std::optional<PvdSeries> series_;
};

}  // namespace tether
