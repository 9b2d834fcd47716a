#include "observation_manager/measurements/stated_unit.hpp"

#include "common/base/error.hpp"

namespace tether {

void check_unit(const CsvTable& table, const std::string& column, const std::string& example) {
  if (table.unit(column).empty())
    throw input_error("{}: the unit of {} must stand in its heading, as in {} [{}]", table.where(0), column, column,
                      example);
}

void check_unit_of_time(const CsvTable& table, bool fractions_of_a_beat) {
  if (!fractions_of_a_beat) return check_unit(table, "time", "ms");
  if (const std::string unit = table.unit("time"); !unit.empty())
    throw input_error(
        "{}: time is in {}, but with beat in the case times are fractions of a beat: give period instead of beat, or "
        "leave out the unit",
        table.where(0), unit);
}

}  // namespace tether
