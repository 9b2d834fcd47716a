#pragma once

#include "common/base/csv.hpp"
#include "common/io/lumen_motion.hpp"
#include "diagnosis/evidence/evidence.hpp"

namespace tether {

/// The lumen, the table and the velocities of a run's folder. What `motion` returns keeps them.
struct StoredRun {
  /// Throws InputError if the folder holds no run, or one that is damaged or cut short.
  explicit StoredRun(const std::filesystem::path& folder);
  FinishedMotion motion() const;
  std::shared_ptr<LumenMotion> lumen;
  std::shared_ptr<CsvTable> table;
  std::shared_ptr<BloodVelocity> velocity;  ///< none if the run recorded none
};

}  // namespace tether
