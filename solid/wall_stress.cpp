#include "solid/wall_stress.hpp"

#include <algorithm>
#include <numeric>

namespace tether {

Mat3 stress_tensor(const Voigt& s) {
  Mat3 m;
  m << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return m;
}

VectorXd von_mises(const Eigen::Matrix<double, 6, Eigen::Dynamic>& stress) {
  VectorXd result(stress.cols());
  for (Eigen::Index e = 0; e < stress.cols(); ++e) {
    const Mat3 s = stress_tensor(stress.col(e)), deviator = s - s.trace() / 3 * Mat3::Identity();
    result[e] = std::sqrt(1.5) * deviator.norm();
  }
  return result;
}

double peak_stress(const WallElements& wall, const Material& material, const Points& x) {
  constexpr double above = 0.01;
  const VectorXd mises = von_mises(wall.cauchy_stress(x, material)), volumes = wall.volumes();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(mises.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return mises[a] > mises[b]; });
  double left = above * volumes.sum();
  for (const Eigen::Index e : order)
    if ((left -= volumes[e]) <= 0) return mises[e];
  return mises[order.back()];
}

}  // namespace tether
