#include "diagnosis/search/held_out_gain.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace tether {
namespace {

constexpr int draws = 2000;

double gain(double before, double after) {
  return before > 0 ? 1 - std::sqrt(std::max(0.0, after) / before) : 0;
}

}  // namespace

Gain gain_of(const VectorXd& precision, const std::vector<int>& block, const VectorXd& before, const VectorXd& after,
             double count) {
  return gain_in_misfit(block, precision.cwiseProduct(before.cwiseAbs2()), precision.cwiseProduct(after.cwiseAbs2()),
                        count);
}

Gain gain_in_misfit(const std::vector<int>& block, const VectorXd& before, const VectorXd& after, double count) {
  std::map<int, std::pair<double, double>> of_block;
  for (Eigen::Index i = 0; i < before.size(); ++i) {
    auto& [one, other] = of_block[block[static_cast<std::size_t>(i)]];
    one += before(i);
    other += after(i);
  }
  std::vector<std::pair<double, double>> blocks;
  double all_before = 0, all_after = 0;
  for (const auto& [number, squares] : of_block) {
    blocks.push_back(squares);
    all_before += squares.first;
    all_after += squares.second;
  }
  std::mt19937_64 generator(1);
  std::vector<double> drawn;
  for (int draw = 0; draw < draws; ++draw) {
    double one = 0, other = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const auto& [b, a] = blocks[generator() % blocks.size()];
      one += b;
      other += a;
    }
    drawn.push_back(gain(one, other));
  }
  std::sort(drawn.begin(), drawn.end());
  const auto above = drawn.end() - std::upper_bound(drawn.begin(), drawn.end(), 0.0);
  const auto in_noise = [&](double misfit) { return std::sqrt(std::max(0.0, misfit) / count); };
  return {gain(all_before, all_after), drawn[draws / 40],   drawn[draws - draws / 40 - 1],
          in_noise(all_before),        in_noise(all_after), static_cast<double>(above) / draws};
}

}  // namespace tether
