#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "fluid/fluid_solver.hpp"
#include "fsi_master/message_partners.hpp"
#include "fsi_master/time_loop.hpp"

namespace tether {

struct WholeCase;

/// The fluid and the solid of a case file, coupled in this process: the programs' own servers behind their messages,
/// the master's own loop, no MPI. The case's `coupling` section tells the method.
class CoupledVessel {
 public:
  explicit CoupledVessel(const std::filesystem::path& case_file);

  /// The next step of the case.
  const StepRecord& advance();
  /// The next ones; what the loops took on average.
  struct Effort {
    double evaluations = 0, krylov_iterations = 0;
  };
  Effort advance(int steps);

  double dt() const { return dt_; }
  int steps_of_case() const { return steps_of_case_; }
  double time() const { return static_cast<double>(step_) * dt_; }
  double tolerance() const { return options_.tolerance; }
  /// An observable of the last step, such as "outlet.flow".
  double of_fluid(const std::string& observable);
  const fluid::FluidSolver& blood() const { return *blood_; }
  /// The interface: y (3 x nodes, reference positions x) and V of the last step.
  const Points& reference() const { return surface_.points; }
  const std::vector<Triangle>& triangles() const { return surface_.triangles; }
  Points displacement() const;
  VectorXd velocity();
  /// From now on measurements correct the run; the case has an observer's gain.
  void observe(ObservationPartner& data, Observer::Form form);
  /// One correction toward data, as of a step of this length.
  void correct_once(ObservationPartner& data, double duration);
  /// Start from where the other stands, with this one's own method and memory of it.
  void stand_where(CoupledVessel& other);

 private:
  explicit CoupledVessel(const WholeCase& all);

  double dt_ = 0;
  int steps_of_case_ = 0;
  const fluid::FluidSolver* blood_ = nullptr;  // of the fluid's server
  protocol::Partner fluid_process_, solid_process_;
  InterfaceSurface surface_;
  MessageSolid solid_;
  std::optional<MessageFluid> fluid_;
  CouplingOptions options_;
  std::unique_ptr<Coupling> coupling_;
  std::optional<TimeLoop> loop_;
  std::optional<Observer> observer_;
  std::int64_t step_ = 0;
  StepRecord last_;
};

}  // namespace tether
