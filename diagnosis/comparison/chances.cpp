#include "diagnosis/comparison/chances.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <numeric>

#include "common/base/error.hpp"

namespace tether {
namespace {

/// What is no number stays none.
using Quiet = boost::math::policies::policy<boost::math::policies::domain_error<boost::math::policies::ignore_error>,
                                            boost::math::policies::overflow_error<boost::math::policies::ignore_error>>;
using Normal = boost::math::normal_distribution<double, Quiet>;
using StudentsT = boost::math::students_t_distribution<double, Quiet>;
using ChiSquared = boost::math::chi_squared_distribution<double, Quiet>;

}  // namespace

double normal_tail(double z) {
  return cdf(complement(Normal(), z));
}

double student_tail(double t, int n) {
  return boost::math::cdf(boost::math::complement(StudentsT(n), t));
}

double normal_quantile(double p) {
  TETHER_ASSERT(p > 0 && p < 1, "{}", p);
  return quantile(Normal(), p);
}

double mean_square_quantile(double n, double z) {
  return std::pow(1 - 2 / (9 * n) + z * std::sqrt(2 / (9 * n)), 3);
}

double chi_square_tail(double x, int n) {
  if (x <= 0) return 1;
  return n == 0 || std::isinf(x) ? 0 : cdf(complement(ChiSquared(n), x));
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
