#include "common/observation/sample.hpp"

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

NodalDistance at_nodes(const std::vector<Sample>& samples, Eigen::Index nodes) {
  NodalDistance result{VectorXd::Zero(nodes), Points::Zero(3, nodes)};
  for (const Sample& s : samples)
    for (std::size_t i = 0; i < 3; ++i) {
      const double share = s.weight * s.shares[static_cast<Eigen::Index>(i)];
      result.weight[s.nodes[i]] += share;
      result.direction.col(s.nodes[i]) += share * s.distance * s.normal;
    }
  for (Eigen::Index node = 0; node < nodes; ++node)
    if (result.weight[node] > 0) result.direction.col(node) /= result.weight[node];  // (O.5)
  return result;
}

}  // namespace tether
