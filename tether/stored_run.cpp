#include "tether/stored_run.hpp"

namespace tether {

StoredRun::StoredRun(const std::filesystem::path& folder)
    : lumen(std::make_shared<LumenMotion>(folder / "lumen.motion")),
      table(std::make_shared<CsvTable>(folder / "timeseries.csv")) {}

FinishedMotion StoredRun::motion() const {
  return {{lumen->times().front(), lumen->times().back(), lumen->imaged(),
           [kept = lumen](double time) { return kept->at(time); }},
          [kept = table](const std::string& column) {
            return RunTrace{kept->numbers("time"), kept->numbers(column), kept->unit(column)};
          }};
}

}  // namespace tether
