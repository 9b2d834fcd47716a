#pragma once

#include <complex>
#include <vector>

namespace tether::fluid {

/// A quantity over time: linear between the given points.
class Curve {
 public:
  /// Zero at all times.
  Curve() = default;
  /// times: strictly increasing. period > 0: repeats; the points must then lie within one period, whose end meets its start.
  /// Otherwise the end values hold outside. Throws InputError.
  Curve(std::vector<double> times, std::vector<double> values, double period = 0);
  static Curve constant(double value) { return {{0.0}, {value}}; }

  double operator()(double time) const;
  double period() const { return period_; }
  bool empty() const { return times_.empty(); }
  /// c_0 ... c_count of value(t) = Re sum_k c_k exp(2 pi i k t / period). Only for a periodic curve.
  std::vector<std::complex<double>> harmonics(int count) const;

 private:
  std::vector<double> times_, values_;
  double period_ = 0;
};

}  // namespace tether::fluid
