#include "diagnosis/chances.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace tether {

double normal_tail(double z) {
  return 0.5 * std::erfc(z / std::numbers::sqrt2);
}

double chi_square_tail(double x, int n) {
  if (x <= 0) return 1;
  const double half = x / 2;
  const bool odd = n % 2 == 1;
  double sum = odd ? std::erfc(std::sqrt(half)) : 0;
  double term = odd ? std::exp(-half) * std::sqrt(half / std::numbers::pi) * 2 : std::exp(-half);
  for (int k = odd ? 3 : 2; k <= n; k += 2) {
    sum += term;
    term *= x / k;
  }
  return std::min(sum, 1.0);
}

double one_sided_tail(double x, int n) {
  if (x <= 0) return 1;
  return 0.5 * ((n > 1 ? chi_square_tail(x, n - 1) : 0) + chi_square_tail(x, n));
}

std::vector<double> holm(const std::vector<double>& p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  std::vector<double> q(p.size());
  double before = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    before = std::clamp(static_cast<double>(order.size() - i) * p[order[i]], before, 1.0);
    q[order[i]] = before;
  }
  return q;
}

}  // namespace tether
