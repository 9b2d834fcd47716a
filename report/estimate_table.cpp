#include "report/estimate_table.hpp"

#include <nlohmann/json.hpp>

#include "common/base/csv.hpp"

namespace tether {
namespace {

using Json = nlohmann::ordered_json;

/// Every so manieth number, and the last.
std::vector<double> thinned(const std::vector<double>& all, std::size_t most) {
  const std::size_t stride = (all.size() + most - 1) / most;
  std::vector<double> kept;
  for (std::size_t i = 0; i + 1 < all.size(); i += stride) kept.push_back(all[i]);
  if (!all.empty()) kept.push_back(all.back());
  return kept;
}

}  // namespace

std::string estimate_over_time(const std::filesystem::path& csv, const std::vector<std::string>& names,
                               std::size_t most) {
  const CsvTable table(csv, TableOf::tether);
  Json json{{"time", thinned(table.numbers("time"), most)}, {"parameters", Json::object()}};
  for (const std::string& name : names)
    for (const auto& [part, column] :
         {std::pair{"value", name}, {"lower", name + ".lower"}, {"upper", name + ".upper"}})
      json["parameters"][name][part] = thinned(table.numbers(column), most);
  return json.dump();
}

}  // namespace tether
