#include "fsi_master/iqn_ils.hpp"

namespace tether {
namespace {

constexpr double relaxation =
    0.01;  // of the very first correction: with a heavy fluid x~ is far off, its direction is not
constexpr double filter = 1e-2;

}  // namespace

IqnIls::IqnIls(FluidPartner& fluid, SolidPartner& solid, const CouplingOptions& options)
    : fluid_(fluid), solid_(solid), options_(options), columns_(options.reuse, filter) {}

CouplingResult IqnIls::solve_step(const StepStart& start, Later<Done> fluid_begins) {
  fluid_begins.get();
  Convergence convergence(options_, start);
  Motion solid;
  VectorXd x = start.velocity, r_old, solved_old;
  if (const VectorXd change = extrapolation_.begin(start); change.size() > 0) x += change;
  if (start.dt != dt_) columns_.forget();  // the derivative of S depends on the step
  dt_ = start.dt;
  columns_.begin_step();
  while (convergence.may_continue()) {
    solid = solid_.motion(fluid_.load(start.motion(x)).get()).get();  // (C.2)
    const VectorXd r = solid.velocity - x;
    if (r_old.size() > 0) columns_.add(r - r_old, solid.velocity - solved_old);
    if (convergence.reached(x, r)) break;
    if (columns_.empty())
      x += relaxation * r;
    else
      x = solid.velocity + columns_.correction(r);  // (C.7)
    r_old = r;
    solved_old = solid.velocity;
  }
  if (convergence.is_reached())
    extrapolation_.end(solid.velocity - start.velocity);
  else
    columns_.forget();
  return std::move(convergence).result(std::move(solid));
}

std::vector<double> IqnIls::memory() const {
  std::vector<double> values = columns_.packed();
  const std::vector<double> guess = extrapolation_.packed();
  values.insert(values.end(), guess.begin(), guess.end());
  values.push_back(dt_);
  values.push_back(static_cast<double>(guess.size()));
  return values;
}

void IqnIls::set_memory(const std::vector<double>& values) {
  const double* end = values.data() + values.size() - 2;
  const double* guess = end - static_cast<std::ptrdiff_t>(end[1]);
  columns_.unpack(values.data(), guess);
  extrapolation_.unpack(guess, end);
  dt_ = end[0];
}

}  // namespace tether
