#pragma once

#include <filesystem>
#include <optional>

#include "common/config/case_file.hpp"
#include "common/io/lumen_motion.hpp"
#include "diagnosis/comparison/run_motion.hpp"
#include "observation_manager/measurements/lumen_surface.hpp"

namespace tether {

/// Why what the folder holds cannot be taken for a finished run of this very case, and of what its files now hold, with
/// at least so many steps; nothing if it can. What the case says of title, identification, diagnosis and output may
/// differ, and, without a state observer, of observations.
std::optional<std::string> why_not_run(const std::filesystem::path& output, const CaseFile& file, int steps);

/// Why such a run cannot be compared with velocities measured at these points; nothing if it can.
std::optional<std::string> why_no_velocity(const std::filesystem::path& output, const Points& points);

/// What a finished run left of its lumen, and the facts of its summary.
struct FinishedRun {
  /// Throws InputError if the folder holds none.
  explicit FinishedRun(const std::filesystem::path& output);
  LumenMotion motion;
  std::optional<BloodVelocity> velocity;  ///< if the case had measurements of it
  int steps = 0;
  double observer_gain = 0;  ///< the largest by which a region was pulled toward the data [1/time]
};

/// What makes its files unreadable: the file and how; nothing if they are whole.
std::optional<std::string> damage_of(const std::filesystem::path& output);

/// The run's motion, which must outlive it. Throws InputError if it is that of another lumen.
RunMotion motion_of(const FinishedRun& run, const LumenSurface& lumen);

}  // namespace tether
