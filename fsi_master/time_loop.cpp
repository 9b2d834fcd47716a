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

std::string told(const std::vector<FailedAttempt>& attempts) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    const auto& [time, dt, cause, seen] = attempts[i];
    const bool again = i > 0 && cause == attempts[i - 1].cause;
    lines.push_back(fmt::format("time {:.6g} s, step {:.3g} s: {}{}", time, dt, again ? "the same" : cause, seen));
  }
  return fmt::format("{}", fmt::join(lines, "\n  then "));
}

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
  throw StepFailure(fmt::format("step {} failed: {}", step, told(record.failures)));
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
  if (!result.converged) record.failures.push_back({time, dt, result.failure, seen_by(result)});
  if (result.converged && observer_ != nullptr && observer_->form() == Observer::Form::split) correct(time + dt, dt);
  return result.converged;
}

/// (O.8) The step is accepted by now: no failure of the correction leads back to its start.
void TimeLoop::correct(double time, double dt) {
  try {
    y_ += observer_->correct(time, dt, y_);
  } catch (const StepFailure& failure) {
    throw run_error("the observer's correction after step {}: {}", step_, failure.what());
  }
}

CouplingResult TimeLoop::solve(const StepStart& start) {
  try {
    if (observer_ != nullptr && observer_->form() == Observer::Form::monolithic) return solve_with_drift(start);
    auto fluid = fluid_.begin_step(start);
    solid_.begin_step(start).get();
    return coupling_.solve_step(start, std::move(fluid));
  } catch (const StepFailure& failure) {
    CouplingResult result;
    result.failure = failure.what();
    return result;
  }
}

/// (O.9): the drift and the step under it, in turn until they agree; each turn leaves gamma dt/2 of the difference. The
/// blood's mesh moves by the first drift before the step: it sees a motion, but no flow.
CouplingResult TimeLoop::solve_with_drift(StepStart start) {
  constexpr int most_turns = 20;
  constexpr double tolerance = 1e-9;  // of the displacement
  solid_.begin_step(start).get();
  start.drift = observer_->begin_drift(start.time, start.dt, start.displacement);
  const VectorXd mesh_moved = start.dt * start.drift;
  CouplingResult all;
  try {
    fluid_.begin_step(start).get();
    for (int turn = 0; turn < most_turns && !all.converged; ++turn) {
      CouplingResult result = coupling_.solve_step(start);
      result.evaluations += all.evaluations;
      result.krylov_iterations += all.krylov_iterations;
      all = std::move(result);
      if (!all.converged) break;
      const VectorXd middle = (start.displacement + all.motion.displacement) / 2,
                     drift = observer_->drift(start.time + start.dt / 2, middle);
      const double change = start.dt * (drift - start.drift).norm();
      start.drift = drift;
      all.motion = start.motion(all.motion.velocity);
      all.converged = change <= tolerance * all.motion.displacement.norm() || change == 0;
      all.failure = all.converged ? "" : "the observer's drift did not converge";
    }
  } catch (const StepFailure& failure) {
    all.converged = false;
    all.failure = failure.what();
  }
  if (all.converged)
    observer_->count(start.dt * start.drift);
  else
    observer_->move_mesh(-mesh_moved);
  return all;
}

/// What one of the codes says against the end of a step comes too late: the other may have ended it already, and they
/// are no state together. That is no step that failed, which could be tried again or saved.
void TimeLoop::end_both(bool accepted, StepRecord& record) {
  try {
    auto fluid = fluid_.end_step(accepted);
    auto solid = solid_.end_step(accepted);
    record.fluid = fluid.get();
    record.solid = solid.get();
  } catch (const StepFailure& failure) {
    throw run_error("step {}, as it was {}: {}", step_, accepted ? "accepted" : "taken back", failure.what());
  }
}

void TimeLoop::finish(const CouplingResult& result, StepRecord& record) {
  end_both(result.converged, record);
  record.evaluations += result.evaluations;
  record.krylov_iterations += result.krylov_iterations;
  if (!result.residuals.empty()) record.residual = result.residuals.back();
  if (!result.converged) return;
  ++record.parts;
  y_ = result.motion.displacement;
  V_ = result.motion.velocity;
}

std::string TimeLoop::seen_by(const CouplingResult& result) const {
  std::string text;
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
