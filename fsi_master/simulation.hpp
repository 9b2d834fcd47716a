#pragma once

#include <filesystem>
#include <functional>

#include "common/base/progress_line.hpp"
#include "common/base/units.hpp"
#include "common/config/fields.hpp"
#include "common/io/lumen_motion.hpp"
#include "common/protocol/messages.hpp"
#include "fsi_master/initial_state.hpp"
#include "fsi_master/progress.hpp"
#include "fsi_master/time_series.hpp"
#include "fsi_master/told_lumen.hpp"

namespace tether {

/// What is simulated for how long, and what of it is kept.
struct RunPlan {
  UnitSystem units = UnitSystem::cgs();
  double start = 0, dt = 0;    ///< [s]
  std::int64_t last_step = 0;  ///< steps of the whole run, those before a resume included
  int write_every = 10, checkpoint_every = 50;
  std::filesystem::path output;
  std::uint64_t fingerprint = 0;
  std::string changes;                  ///< of the case since what is there was begun, in words
  std::string coupling;                 ///< the section of the case, JSON; it may change at a continuation
  StateOrigin origin;                   ///< of its states
  std::optional<InitialState> initial;  ///< none: at rest
  bool resume = false, quiet = false;
  bool write_series = true;               ///< the codes' files for viewing
  double image_pressure = 0;              ///< to which the run's pressures are relative
  Named<Vec3> points;                     ///< their displacement is recorded
  Points velocity_points = Points(3, 0);  ///< of space, where the velocity is recorded [length]

  double time_at(std::int64_t step) const { return start + static_cast<double>(step) * dt; }
};

/// A named point and the interface node that stands for it.
struct FollowedNode {
  std::string name;
  int node = 0;
  double distance = 0;  ///< between the two [length]
};

/// The codes and the method of a run, and what they announced.
struct Crew {
  FluidPartner& fluid;
  SolidPartner& solid;
  Coupling& coupling;
  Points interface;  ///< reference positions of the master's interface nodes
  ToldLumen lumen;   ///< of lumen.motion
  std::vector<protocol::ObservableInfo> fluid_observables, solid_observables;
  Observer* observer = nullptr;  ///< none: the run is not corrected
  /// What the processes have cost since they started, in the order of RunStatistics; nobody asks if it is not set.
  std::function<std::vector<PartnerUsage>()> usage = {};
};

/// A direct simulation: steps, table, files for viewing, checkpoints, progress.
class Simulation {
 public:
  Simulation(RunPlan plan, Crew crew, int halvings);

  /// At the start, or at the checkpoint. Throws InputError if that is none of this run's.
  void begin();
  /// From there to the last step. Throws RunError if a step fails for good (the last good state is then on the disk) or
  /// after a signal (the last checkpoint is).
  void run();

  const RunPlan& plan() const { return plan_; }
  const RunStatistics& statistics() const { return statistics_; }
  const std::vector<FollowedNode>& followed() const { return followed_; }
  std::int64_t first_step() const { return first_step_; }
  /// Whether steps before a continuation were coupled by other settings.
  bool coupled_otherwise() const { return coupled_otherwise_; }
  const Observer* observer() const { return crew_.observer; }
  /// Of timeseries.csv.
  std::vector<Column> columns() const;

 private:
  void advance(std::int64_t step);
  /// What follows `step`; a state from which no step can be made is saved.
  StepRecord compute(std::int64_t step);
  void record(std::int64_t step, const StepRecord& record, double seconds);
  void record_fields(double time);
  std::vector<double> row(std::int64_t step, const StepRecord& record) const;
  void note_fluid(const std::vector<double>& observables);
  void write_files(std::int64_t step);
  void save(std::int64_t step);
  /// The newest checkpoint that the tables reach, which go on behind it.
  Checkpoint taken_up();
  /// Adds what the processes have cost since the last time.
  void count_costs(bool of_steps);
  /// For a person whose run has ended early.
  std::string what_is_saved() const;
  Vec3 displacement_of(int node) const { return loop_.displacement().segment<3>(3 * node); }
  Points displacement() const;
  Points told_displacement() const;
  double largest_displacement() const;

  RunPlan plan_;
  Crew crew_;
  TimeLoop loop_;
  std::vector<FollowedNode> followed_;
  TimeSeries series_;
  LumenMotionWriter motion_;
  std::optional<BloodVelocityWriter> velocity_;
  RunStatistics statistics_;
  std::vector<PartnerUsage> counted_;  ///< the processes' usage that is in the statistics
  MinMax pressure_now_;
  std::int64_t first_step_ = 0;
  bool coupled_otherwise_ = false;
  std::optional<std::int64_t> saved_step_;
  std::optional<ProgressLine> progress_;
};

}  // namespace tether
