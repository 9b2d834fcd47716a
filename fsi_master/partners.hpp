#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/base/error.hpp"
#include "common/base/types.hpp"
#include "fsi_master/later.hpp"

/// The two codes as the coupling sees them. Vectors are in the order of the master's interface: the solid's nodes,
/// x0 y0 z0 x1 ...; `message_partners.hpp` speaks to processes, the tests have fakes.
namespace tether {

/// A partner could not do the step (an inverted mesh, a solve that diverges): another try with a smaller step may
/// succeed.
struct StepFailure : RunError {
  using RunError::RunError;
};

/// The interface at the end of the step.
struct Motion {
  VectorXd displacement;  ///< y1 [length]
  VectorXd velocity;      ///< V = (y1 - y0)/dt [length/time]
};

/// Where a step starts: what both codes know before it.
struct StepStart {
  std::int64_t step = 0;  ///< its number, for messages to people
  double time = 0, dt = 0;
  VectorXd displacement;  ///< y0
  VectorXd velocity;      ///< V0 = (y0 - y_-1)/dt of the last converged step
  VectorXd drift = {};    ///< rate at which an observer moves the interface beside V (O.9); empty: none

  VectorXd predicted() const { return moved(velocity); }  // (C.1)
  Motion motion(const VectorXd& V) const { return {moved(V), V}; }

 private:
  VectorXd moved(const VectorXd& V) const {
    VectorXd y = displacement + dt * V;
    if (drift.size() > 0) y += dt * drift;
    return y;
  }
};

struct Done {};

/// Processor time and memory that a partner has taken so far.
struct PartnerUsage {
  double cpu_seconds = 0, peak_memory_mb = 0;
};

/// Distances from the interface's nodes to measurements, along normals, and the areas they stand for (0: none).
struct Innovation {
  VectorXd weights, distances, normals;  ///< normals: x0 y0 z0 x1 ...
};

/// What every partner of a coupled step does.
class StepPartner {
 public:
  virtual ~StepPartner() = default;
  virtual std::string name() const = 0;
  virtual bool has_tangent() const = 0;
  virtual bool has_state() const = 0;

  virtual Later<Done> begin_step(const StepStart& start) = 0;
  /// The partner's observables, in the order it announced.
  virtual Later<std::vector<double>> end_step(bool accepted) = 0;
  /// Everything it needs to continue.
  virtual Later<std::vector<double>> state() = 0;
  virtual Later<Done> set_state(std::vector<double> values) = 0;
  virtual Later<Done> write(std::int64_t step, double time) = 0;
  virtual Later<PartnerUsage> usage() = 0;
};

/// F: interface motion -> nodal forces [force]; linear in V within a step.
class FluidPartner : public StepPartner {
 public:
  virtual Later<VectorXd> load(const Motion& motion) = 0;
  /// dF = -A dV, A symmetric positive semi-definite (the added mass over dt).
  virtual Later<VectorXd> load_change(const VectorXd& velocity_change) = 0;

  virtual bool has_observer() const { return false; }
  /// Between two steps: the interface and the mesh move, nothing flows. Throws StepFailure if the mesh would break;
  /// nothing has changed then.
  virtual Later<Done> move_interface(const VectorXd&) { throw InternalError("no observer"); }

  virtual bool has_velocity() const { return false; }
  /// After the last accepted step, at points of space (3 x n); NaN outside the lumen.
  virtual Later<Points> velocity_at(const Points&) { throw InternalError("no velocity"); }
};

/// S: nodal forces -> interface motion; and, from a code that announces operators, its equations themselves.
class SolidPartner : public StepPartner {
 public:
  struct Iterate {
    VectorXd residual;  ///< of all unknowns [force]: load - internal, inertial and support forces
    Motion motion;      ///< of the interface, at the iterate
  };

  virtual bool has_operators() const = 0;
  virtual Later<Motion> motion(const VectorXd& load) = 0;
  /// Velocity part of dS(load_change).
  virtual Later<VectorXd> velocity_change(const VectorXd& load_change) = 0;

  /// Adds `correction` (empty: none) to the iterate of all unknowns; interface velocities come first.
  virtual Later<Iterate> residual(const VectorXd& correction, const VectorXd& load) = 0;
  /// J v, symmetric positive definite on the free unknowns.
  virtual Later<VectorXd> product(const VectorXd& direction) = 0;
  /// About J^-1 r; zero where the motion is prescribed.
  virtual Later<VectorXd> precondition(const VectorXd& residual) = 0;

  virtual bool has_observer() const { return false; }
  /// Moves the wall toward the data by what its gain makes of dt; how far the interface has moved.
  virtual Later<VectorXd> correct(double, const Innovation&) { throw InternalError("no observer"); }
  /// Takes a share of the last correction back.
  virtual Later<Done> withdraw(double) { throw InternalError("no observer"); }
  /// Sets the rate at which the wall moves toward the data during the step begun; its interface part.
  virtual Later<VectorXd> set_drift(const Innovation&) { throw InternalError("no observer"); }
};

/// Measurements of the lumen.
class ObservationPartner {
 public:
  virtual ~ObservationPartner() = default;
  /// points: positions of the interface's nodes.
  virtual Later<Innovation> observe(double time, const VectorXd& points) = 0;
};

}  // namespace tether
