#include "observation_manager/measurements/sample.hpp"

namespace tether {

std::string_view meaning_of(Exclusion exclusion) {
  constexpr std::array<std::string_view, exclusion_count> meanings{
      "observed",    "beside an open rim",        "farther than the trust distance", "in a masked region",
      "near an end", "where the data are flawed", "at a time without frames",        "missed by the model",
      "held out"};
  return meanings[static_cast<std::size_t>(exclusion)];
}

std::array<int, exclusion_count> count_exclusions(const std::vector<Sample>& samples) {
  std::array<int, exclusion_count> counts{};
  for (const Sample& sample : samples) ++counts[static_cast<std::size_t>(sample.excluded)];
  return counts;
}

double misfit(const std::vector<Sample>& samples) {
  double sum = 0;
  for (const Sample& s : samples) sum += s.weight * s.distance * s.distance;  // (O.4)
  return sum;
}

}  // namespace tether
