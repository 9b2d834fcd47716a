#include "vessel/growth/minimise.hpp"

#include <cmath>
#include <deque>
#include <vector>

namespace tether {

namespace {

/// What the last steps tell of the curvature.
class StepMemory {
 public:
  void add(VectorXd step, VectorXd gradient_change) {
    const double product = step.dot(gradient_change);
    if (!(product > 1e-12 * step.norm() * gradient_change.norm())) return;
    pairs_.push_back({std::move(step), std::move(gradient_change), 1 / product});
    if (pairs_.size() > 10) pairs_.pop_front();
  }

  VectorXd direction(const VectorXd& gradient) const {
    VectorXd d = -gradient;
    std::vector<double> taken(pairs_.size());
    for (std::size_t i = pairs_.size(); i-- > 0;) {
      taken[i] = pairs_[i].inverse_product * pairs_[i].step.dot(d);
      d -= taken[i] * pairs_[i].change;
    }
    if (!pairs_.empty()) d /= pairs_.back().inverse_product * pairs_.back().change.squaredNorm();
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      d += (taken[i] - pairs_[i].inverse_product * pairs_[i].change.dot(d)) * pairs_[i].step;
    return d;
  }

  bool empty() const { return pairs_.empty(); }
  void clear() { pairs_.clear(); }

 private:
  struct Pair {
    VectorXd step, change;
    double inverse_product;
  };
  std::deque<Pair> pairs_;
};

constexpr int most_halvings = 30;
constexpr double armijo = 1e-4;

}  // namespace

Minimum minimise(const Differentiable& function, VectorXd x, int steps, double tolerance) {
  VectorXd gradient(x.size()), next_gradient(x.size());
  Minimum at{std::move(x), 0, 1};
  at.value = function(at.x, gradient);
  StepMemory memory;
  int small = 0;
  for (int step = 0; step < steps && gradient.norm() > 0 && small < 3; ++step) {
    VectorXd direction = memory.direction(gradient);
    if (!(direction.dot(gradient) < 0)) memory.clear(), direction = -gradient;
    double length = memory.empty() ? 1 / std::max(1.0, gradient.norm()) : 1;
    const double slope = direction.dot(gradient);
    VectorXd next;
    double value = 0;
    int halvings = 0;
    for (; halvings < most_halvings; ++halvings, length /= 2) {
      next = at.x + length * direction;
      value = function(next, next_gradient);
      ++at.evaluations;
      if (value <= at.value + armijo * length * slope) break;
    }
    if (halvings == most_halvings) break;
    small = at.value - value < tolerance * std::abs(at.value) ? small + 1 : 0;
    memory.add(next - at.x, next_gradient - gradient);
    at.x = std::move(next);
    at.value = value;
    gradient = next_gradient;
  }
  return at;
}

}  // namespace tether
