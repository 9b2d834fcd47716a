#include "fsi_master/simulation.hpp"

#include <chrono>

#include "common/base/end_request.hpp"
#include "common/base/folder_lock.hpp"
#include "common/base/way_on.hpp"
#include "common/protocol/signals.hpp"

namespace tether {
namespace {

std::vector<FollowedNode> nearest_nodes(const Named<Vec3>& points, const Points& interface) {
  std::vector<FollowedNode> followed;
  for (const auto& [name, position] : points) {
    Eigen::Index node = 0;
    const double squared = (interface.colwise() - position).colwise().squaredNorm().minCoeff(&node);
    followed.push_back({name, static_cast<int>(node), std::sqrt(squared)});
  }
  return followed;
}

}  // namespace

Simulation::Simulation(RunPlan plan, Crew crew, int halvings)
    : plan_(std::move(plan)),
      crew_(std::move(crew)),
      loop_(crew_.fluid, crew_.solid, crew_.coupling, crew_.interface.reshaped(), halvings),
      followed_(nearest_nodes(plan_.points, crew_.interface)),
      series_(plan_.output / "timeseries.csv", columns(), plan_.units),
      motion_(plan_.output / "lumen.motion", crew_.lumen.points) {
  if (crew_.observer != nullptr) loop_.observe(*crew_.observer);
  if (plan_.velocity_points.cols() > 0) velocity_.emplace(plan_.output / "blood.velocity", plan_.velocity_points);
}

void Simulation::run() {
  progress_.emplace(first_step_, plan_.last_step, plan_.quiet);
  std::int64_t step = first_step_;
  try {
    for (; step < plan_.last_step; ++step) {
      advance(step);
      if (end_is_requested() && step + 1 < plan_.last_step) {
        save(step + 1);
        throw protocol::Interrupted(told_to_end);
      }
    }
  } catch (const protocol::Interrupted& interrupted) {
    progress_->end_line();
    throw protocol::Interrupted(fmt::format("{} in step {}\n{}", interrupted.what(), step + 1, what_is_saved()));
  } catch (...) {
    progress_->end_line();
    throw;
  }
  if (plan_.last_step > first_step_) save(plan_.last_step);
}

void Simulation::begin() {
  if (!plan_.resume) {
    if (plan_.initial) plan_.initial->put(loop_);
    count_costs(false);
    series_.start();
    motion_.start();
    if (velocity_) velocity_->start();
    record_fields(plan_.start);
    return write_files(0);
  }
  const Checkpoint checkpoint = taken_up();
  if (!checkpoint.refused.empty())
    fmt::print(stderr, "{}: the run goes on from the checkpoint before, step {}\n", checkpoint.refused,
               checkpoint.step);
  loop_.restore(checkpoint.snapshot);
  statistics_ = checkpoint.statistics;
  count_costs(false);
  coupled_otherwise_ = checkpoint.coupling != plan_.coupling;
  saved_step_ = first_step_ = checkpoint.step;
  if (plan_.last_step < first_step_)
    fmt::print(stderr, "nothing is left to do: the run went on to {:.6g} s, and time.end is {:.6g} s\n",
               plan_.time_at(first_step_), plan_.time_at(plan_.last_step));
  plan_.last_step = std::max(plan_.last_step, first_step_);
}

Checkpoint Simulation::taken_up() {
  const auto take_up_tables = [&](const Checkpoint& of) {
    series_.resume(of.step, static_cast<std::uint64_t>(of.table));
    motion_.resume(of.step + 1, static_cast<std::uint64_t>(of.motion));
    if (velocity_) velocity_->resume(of.step + 1, static_cast<std::uint64_t>(of.velocity));
  };
  Checkpoint checkpoint = read_checkpoint(plan_.output, plan_.fingerprint, plan_.changes);
  try {
    take_up_tables(checkpoint);
    return checkpoint;
  } catch (const InputError& error) {
    checkpoint.refused = error.what();
  }
  if (std::optional<Checkpoint> before = checkpoint_before(plan_.output, checkpoint)) try {
      take_up_tables(*before);
      before->refused = checkpoint.refused;
      return *before;
    } catch (const InputError&) {  // what was wrong first is told
    }
  throw input_error("{}: start anew without --resume", checkpoint.refused);
}

void Simulation::advance(std::int64_t step) {
  check_held(plan_.output);
  const auto begun = std::chrono::steady_clock::now();
  const StepRecord done = compute(step);
  if (!done.failures.empty())
    progress_->note(fmt::format("step {} is repeated in halves: {}", step + 1, told(done.failures)));
  if ((step + 1) % plan_.write_every == 0 || step + 1 == plan_.last_step) write_files(step + 1);
  record(step + 1, done, seconds_since(begun));
  if ((step + 1) % plan_.checkpoint_every == 0 && step + 1 < plan_.last_step) save(step + 1);
}

StepRecord Simulation::compute(std::int64_t step) {
  try {
    return loop_.advance(step + 1, plan_.time_at(step), plan_.dt);
  } catch (const StepFailure& failure) {
    save(step);
    throw StepFailure(fmt::format("{}\n{}", failure.what(), what_is_saved()));
  }
}

void Simulation::record(std::int64_t step, const StepRecord& record, double seconds) {
  statistics_.evaluations.add(record.evaluations);
  statistics_.krylov_iterations.add(record.krylov_iterations);
  statistics_.max_displacement = std::max(statistics_.max_displacement, largest_displacement());
  statistics_.repeated_steps += record.parts > 1 ? 1 : 0;
  statistics_.wall_seconds += seconds;
  note_fluid(record.fluid);
  series_.append(row(step, record));
  record_fields(plan_.time_at(step));
  MinMax shown;  // absolute, as a person thinks of it
  for (const double relative : {pressure_now_.min, pressure_now_.max})
    if (!pressure_now_.empty()) shown.add(plan_.image_pressure + relative);
  progress_->show(step, text_of({plan_.time_at(step), record.evaluations, shown, largest_displacement()}, plan_.units));
}

void Simulation::record_fields(double time) {
  motion_.append(time, told_displacement());
  if (velocity_) velocity_->append(time, crew_.fluid.velocity_at(velocity_->points()).get());
}

/// Takes the mass balance and the pressures out of the fluid's observables, which it names as docs/protocol.md says.
void Simulation::note_fluid(const std::vector<double>& observables) {
  pressure_now_ = {};
  for (std::size_t i = 0; i < observables.size(); ++i) {
    const std::string& name = crew_.fluid_observables[i].name;
    if (name == "mass_balance_error")
      statistics_.mass_balance_error = std::max(statistics_.mass_balance_error, std::abs(observables[i]));
    if (name == "pressure" || name.ends_with(".pressure")) pressure_now_.add(observables[i]);
  }
  if (pressure_now_.empty()) return;
  statistics_.pressure.add(pressure_now_.min);
  statistics_.pressure.add(pressure_now_.max);
}

std::vector<Column> Simulation::columns() const {
  const std::string length = plan_.units.symbol(dimension::length);
  std::vector<Column> columns{{"time", "s"}};
  for (const auto& info : crew_.fluid_observables) columns.push_back({"fluid." + info.name, info.unit});
  for (const auto& info : crew_.solid_observables) columns.push_back({"solid." + info.name, info.unit});
  for (const auto& point : followed_)
    for (const char* part : {"x", "y", "z", "length"})
      columns.push_back({"point." + point.name + ".displacement_" + part, length});
  columns.push_back({"interface.max_displacement", length});
  for (const char* name : {"evaluations", "krylov_iterations", "residual", "parts"})
    columns.push_back({std::string("coupling.") + name, ""});
  return columns;
}

/// In the order of `columns`.
std::vector<double> Simulation::row(std::int64_t step, const StepRecord& record) const {
  std::vector<double> row{plan_.time_at(step)};
  row.insert(row.end(), record.fluid.begin(), record.fluid.end());
  row.insert(row.end(), record.solid.begin(), record.solid.end());
  for (const auto& point : followed_) {
    const Vec3 y = displacement_of(point.node);
    row.insert(row.end(), {y(0), y(1), y(2), y.norm()});
  }
  row.insert(row.end(),
             {largest_displacement(), static_cast<double>(record.evaluations),
              static_cast<double>(record.krylov_iterations), record.residual, static_cast<double>(record.parts)});
  return row;
}

Points Simulation::displacement() const {
  return Eigen::Map<const Points>(loop_.displacement().data(), 3, crew_.interface.cols());
}

Points Simulation::told_displacement() const {
  return crew_.lumen.of(loop_.displacement()).reshaped(3, crew_.lumen.points.cols());
}

double Simulation::largest_displacement() const {
  return displacement().colwise().norm().maxCoeff();
}

void Simulation::write_files(std::int64_t step) {
  if (!plan_.write_series) return;
  auto fluid = crew_.fluid.write(step, plan_.time_at(step));
  auto solid = crew_.solid.write(step, plan_.time_at(step));
  fluid.get();
  solid.get();
}

void Simulation::count_costs(bool of_steps) {
  if (!crew_.usage) return;
  const std::vector<PartnerUsage> now = crew_.usage();
  counted_.resize(now.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    ProcessTotals& all = statistics_.processes.at(i);
    const double since = now[i].cpu_seconds - counted_[i].cpu_seconds;
    all.cpu_seconds += since;
    if (of_steps) all.loop_cpu_seconds += since;
    all.peak_memory_mb = std::max(all.peak_memory_mb, now[i].peak_memory_mb);
  }
  counted_ = now;
}

void Simulation::save(std::int64_t step) {
  count_costs(true);
  std::string without_state;
  if (!crew_.fluid.has_state()) without_state = crew_.fluid.name();
  if (!crew_.solid.has_state()) without_state += (without_state.empty() ? "" : " and ") + crew_.solid.name();
  const std::string coupling = coupled_otherwise_ ? "several" : plan_.coupling;
  StateOrigin origin = plan_.origin;
  origin.time = plan_.time_at(step);
  series_.flush();
  motion_.flush();
  if (velocity_) velocity_->flush();
  Checkpoint checkpoint{step, plan_.fingerprint, loop_.snapshot(), statistics_, without_state, coupling, origin};
  checkpoint.table = static_cast<std::int64_t>(series_.checksum());
  checkpoint.motion = static_cast<std::int64_t>(motion_.checksum());
  if (velocity_) checkpoint.velocity = static_cast<std::int64_t>(velocity_->checksum());
  write_checkpoint(plan_.output, checkpoint);
  saved_step_ = step;
}

std::string Simulation::what_is_saved() const {
  if (!saved_step_) return fmt::format("{} yet", no_state_saved);
  return fmt::format("{}{} steps is in {}", state_after, *saved_step_, (plan_.output / "checkpoint").string());
}

}  // namespace tether
