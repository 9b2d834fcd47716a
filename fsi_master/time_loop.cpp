#include "fsi_master/time_loop.hpp"

#include <fmt/ranges.h>

namespace tether {
namespace {

std::vector<double> packed(const VectorXd& v) {
  return {v.begin(), v.end()};
}

VectorXd unpacked(const std::vector<double>& v) {
  return Eigen::Map<const VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

}  // namespace

TimeLoop::TimeLoop(FluidPartner& fluid, SolidPartner& solid, Coupling& coupling, VectorXd rest, int halvings)
    : fluid_(fluid),
      solid_(solid),
      coupling_(coupling),
      rest_(std::move(rest)),
      y_(VectorXd::Zero(rest_.size())),
      V_(VectorXd::Zero(rest_.size())),
      halvings_(halvings) {}

StepRecord TimeLoop::advance(std::int64_t step, double time, double dt) {
  step_ = step;
  StepRecord record;
  if (attempt(time, dt, record)) return record;
  const Snapshot before = snapshot();
  if (advance_in_halves(time, dt, 1, record)) return record;
  restore(before);
  throw StepFailure(fmt::format("step {} failed: {}", step, fmt::join(record.failures, "\n  then ")));
}

bool TimeLoop::advance_in_halves(double time, double dt, int level, StepRecord& record) {
  if (level > halvings_) return false;
  const double half = dt / 2;
  for (const double start : {time, time + half})
    if (!attempt(start, half, record) && !advance_in_halves(start, half, level + 1, record)) return false;
  return true;
}

/// One time step of both codes. If it fails they are back where it began.
bool TimeLoop::attempt(double time, double dt, StepRecord& record) {
  const StepStart start{step_, time, dt, y_, V_};  // V_ is (y0 - y_-1)/dt, not the midpoint velocity, which rings (C.1)
  const CouplingResult result = solve(start);
  finish(result, record);
  if (!result.converged) record.failures.push_back(explain(result, time, dt));
  return result.converged;
}

CouplingResult TimeLoop::solve(const StepStart& start) {
  try {
    auto fluid = fluid_.begin_step(start);
    auto solid = solid_.begin_step(start);
    fluid.get();
    solid.get();
    return coupling_.solve_step(start);
  } catch (const StepFailure& failure) {
    CouplingResult result;
    result.failure = failure.what();
    return result;
  }
}

void TimeLoop::finish(const CouplingResult& result, StepRecord& record) {
  auto fluid = fluid_.end_step(result.converged);
  auto solid = solid_.end_step(result.converged);
  record.fluid = fluid.get();
  record.solid = solid.get();
  record.evaluations += result.evaluations;
  record.krylov_iterations += result.krylov_iterations;
  if (!result.residuals.empty()) record.residual = result.residuals.back();
  if (!result.converged) return;
  ++record.parts;
  y_ = result.motion.displacement;
  V_ = result.motion.velocity;
}

std::string TimeLoop::explain(const CouplingResult& result, double time, double dt) const {
  std::string text = fmt::format("time {:.6g} s, step {:.3g} s: {}", time, dt, result.failure);
  if (!result.residuals.empty()) text += fmt::format("; residuals {:.2e}", fmt::join(result.residuals, " "));
  if (result.worst_node < 0) return text;
  const Vec3 x = (rest_ + y_).segment<3>(3 * result.worst_node);
  return text +
         fmt::format("; worst at interface node {} near ({:.4g}, {:.4g}, {:.4g})", result.worst_node, x(0), x(1), x(2));
}

Snapshot TimeLoop::snapshot() {
  Snapshot snapshot{{}, {}, packed(y_), packed(V_), coupling_.name(), coupling_.memory()};
  if (fluid_.has_state()) snapshot.fluid = fluid_.state().get();
  if (solid_.has_state()) snapshot.solid = solid_.state().get();
  return snapshot;
}

void TimeLoop::restore(const Snapshot& snapshot) {
  if (fluid_.has_state()) fluid_.set_state(snapshot.fluid).get();
  if (solid_.has_state()) solid_.set_state(snapshot.solid).get();
  y_ = unpacked(snapshot.displacement);
  V_ = unpacked(snapshot.velocity);
  if (snapshot.method == coupling_.name()) coupling_.set_memory(snapshot.coupling);
}

}  // namespace tether
