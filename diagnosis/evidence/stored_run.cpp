#include "diagnosis/evidence/stored_run.hpp"

#include "common/io/record_file.hpp"
#include "identification_master/results/made_run.hpp"

namespace tether {

StoredRun::StoredRun(const std::filesystem::path& folder)
    : lumen(std::make_shared<LumenMotion>(folder / "lumen.motion")),
      table(std::make_shared<CsvTable>(folder / "timeseries.csv", TableOf::tether)) {
  if (std::filesystem::exists(folder / "blood.velocity"))
    velocity = std::make_shared<BloodVelocity>(folder / "blood.velocity");
  if (const auto made = folder / "run.json"; std::filesystem::exists(made))
    check_is_whole(folder, read_record<MadeRun>(made).steps);
}

FinishedMotion StoredRun::motion() const {
  return {{lumen->times().front(), lumen->times().back(), lumen->imaged(),
           [kept = lumen](double time) { return kept->at(time); }},
          [kept = table](const std::string& column) {
            return RunTrace{kept->numbers("time"), kept->numbers(column), kept->unit(column)};
          },
          [kept = velocity](const Points& points, double time) -> Points {
            const Eigen::Index first = place_of(points, kept == nullptr ? Points(3, 0) : kept->points());
            return kept->vectors_at(time).middleCols(first, points.cols());
          }};
}

}  // namespace tether
