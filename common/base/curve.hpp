#pragma once

#include <vector>

namespace tether {

/// From 0 at t = 0 to 1 at t = ramp, smoothly: (1 - cos(pi t/ramp))/2; 1 without a ramp.
double onset(double time, double ramp);

/// How a table of times and values becomes a function of time.
struct CurveShape {
  double period = 0.0;  ///< the table repeats; 0: it does not, and its ends are held
  double ramp = 0.0;    ///< time in which the value rises smoothly from zero, from t = 0 on; 0: at once
  double scale = 1.0;
};

/// A function of time: f(t) = scale r(t / ramp) linear(t), with r(s) = (1 - cos(pi s)) / 2 for 0 < s < 1.
class Curve {
 public:
  /// `times` ascending, at least one, spanning no more than a period.
  Curve(std::vector<double> times, std::vector<double> values, const CurveShape& shape = {});
  static Curve constant(double value, double ramp = 0.0) { return Curve({0.0}, {value}, {0.0, ramp, 1.0}); }

  double operator()(double time) const;

 private:
  double interpolated(double time) const;

  std::vector<double> times_, values_;
  CurveShape shape_;
};

}  // namespace tether
