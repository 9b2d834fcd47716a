#include "fsi_master/observer.hpp"

namespace tether {
namespace {

constexpr int most_halvings = 4;

double largest_move(const VectorXd& change) {
  return change.reshaped(3, change.size() / 3).colwise().norm().maxCoeff();
}

}  // namespace

Observer::Observer(ObservationPartner& data, FluidPartner& fluid, SolidPartner& solid, Form form, VectorXd rest)
    : data_(data), fluid_(fluid), solid_(solid), form_(form), rest_(std::move(rest)) {}

VectorXd Observer::correct(double time, double dt, const VectorXd& y) {
  VectorXd change = solid_.correct(dt, data_.observe(time, rest_ + y).get()).get();
  for (int halving = 0;; ++halving) {
    try {
      move_mesh(change);
      count(change);
      return change;
    } catch (const StepFailure&) {
      ++statistics_.weakened;
    }
    const double share = halving < most_halvings ? 0.5 : 1.0;
    solid_.withdraw(share).get();
    change *= 1 - share;
    if (share < 1.0) continue;
    count(change);
    return change;
  }
}

void Observer::count(const VectorXd& change) {
  ++statistics_.corrections;
  statistics_.largest = std::max(statistics_.largest, largest_move(change));
}

VectorXd Observer::begin_drift(double time, double dt, const VectorXd& y) {
  share_ = 1;
  for (int halving = 0; halving <= most_halvings; ++halving) {
    const VectorXd rate = drift(time, y);
    try {
      move_mesh(dt * rate);
      return rate;
    } catch (const StepFailure&) {
      ++statistics_.weakened;
    }
    share_ = halving < most_halvings ? share_ / 2 : 0;
  }
  return drift(time, y);
}

VectorXd Observer::drift(double time, const VectorXd& y) {
  Innovation data = data_.observe(time, rest_ + y).get();
  data.distances *= share_;
  return solid_.set_drift(data).get();
}

}  // namespace tether
