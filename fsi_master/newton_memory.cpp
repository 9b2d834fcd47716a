#include "fsi_master/newton_memory.hpp"

#include "common/base/error.hpp"

namespace tether {

VectorXd NewtonMemory::begin(const StepStart& start) {
  if (start.dt != dt_) {
    directions_.forget();
    share_left_ = 0;
  }
  dt_ = start.dt;
  return guess_.begin(start);
}

std::vector<double> NewtonMemory::packed() const {
  const std::vector<double> directions = directions_.packed(), guess = guess_.packed();
  std::vector<double> values{dt_, share_left_};
  values.insert(values.end(), directions.begin(), directions.end());
  values.insert(values.end(), guess.begin(), guess.end());
  values.push_back(static_cast<double>(directions.size()));
  return values;
}

void NewtonMemory::unpack(const std::vector<double>& values) {
  TETHER_ASSERT(values.size() > 3, "a memory of {} numbers", values.size());
  dt_ = values[0];
  share_left_ = values[1];
  const double *directions = values.data() + 2, *guess = directions + static_cast<std::ptrdiff_t>(values.back());
  directions_.unpack(directions, guess);
  guess_.unpack(guess, values.data() + values.size() - 1);
}

}  // namespace tether
