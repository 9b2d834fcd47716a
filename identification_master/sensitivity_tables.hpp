#pragma once

#include <filesystem>
#include <optional>

#include "identification_master/identification.hpp"
#include "observation_manager/measurements/observations.hpp"

namespace tether {

/// What each observation has to do with each parameter, written step by step (docs/identification.md):
///
/// OUTPUT/sensitivities.csv: a row for each step, series and region of the lumen, or source of the blood.
/// OUTPUT/sensitivities_of_data.csv: a row for each datum of a step with a frame of its own.
class SensitivityTables {
 public:
  /// `lumen`: to know where each sample lies. deviations: of each datum.
  SensitivityTables(const std::filesystem::path& output, const Observations& data, const LumenSurface& lumen,
                    const std::vector<std::string>& parameters, VectorXd deviations, const UnitSystem& units);

  /// Empty tables, or those that are there without what lies behind a time. Throws RunError if the disk refuses.
  void begin();
  void continue_from(double time);
  void add(const StepSensitivities& step);

  static constexpr const char *by_region = "sensitivities.csv", *by_datum = "sensitivities_of_data.csv";

 private:
  /// Data that share a row: of one series in one region, or a source.
  struct Group {
    std::string observation, region, unit;
    std::vector<Eigen::Index> data;
  };
  void add_source(const Measurement& source, const LumenSurface& lumen, const std::string& unit);
  std::string row_of(const Group& group, const StepSensitivities& step) const;
  std::string rows_of_data(const Group& group, const StepSensitivities& step) const;

  std::filesystem::path output_;
  std::vector<std::string> parameters_;
  std::vector<Group> groups_;
  std::vector<std::optional<Vec3>> positions_;  ///< in the image, of data that have one
  VectorXd deviations_;
};

}  // namespace tether
