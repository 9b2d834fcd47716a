#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

/// The messages between a master and its partners (fluid, solid, observation_manager). Plain structs, one variant a direction.
/// Each lists its fields once, in `fields`: that is the order on the wire (docs/protocol.md).
/// Arrays of vectors are node by node: x0 y0 z0 x1 y1 z1 ..., nodes in the order of the partner's `Interface` message.
/// Every request has exactly one reply: the type named beside it, or `Failure`.
namespace tether::protocol {

inline constexpr std::int64_t version = 1;

#define TETHER_FIELDS(...)                                        \
  template <class Archive>                                        \
  void fields(Archive& archive) { archive(__VA_ARGS__); }

/// A number of the partner that the master may set by name.
struct ParameterInfo {
  std::string name, meaning, unit, transform;
  double value = 0, absent = 0, lower = 0, upper = 0, prior_deviation = 0;  ///< absent, prior_deviation: NaN if undefined
  TETHER_FIELDS(name, meaning, unit, transform, value, absent, lower, upper, prior_deviation)
};

/// A scalar that the partner reports after every accepted step, such as "outlet.flow" in cm3/s.
struct ObservableInfo {
  std::string name, unit;
  TETHER_FIELDS(name, unit)
};

// ---- partner -> master, once, unasked -------------------------------------------------------------------------------

/// First message of a partner. `failure` is not empty if its input is wrong: the master then reports it and ends.
struct Hello {
  std::int64_t protocol_version = version;
  std::string role;     ///< "fluid", "solid", "fluid_observation", "solid_observation"
  std::string program;  ///< name and version, for the summary
  std::string host;
  std::int64_t pid = 0;
  bool has_tangent = false;    ///< answers FluidTangent / SolidTangent
  bool has_operators = false;  ///< solid: answers SolidResidual, SolidProduct, SolidPrecondition
  bool has_state = false;      ///< answers GetState, SetState
  std::int64_t state_size = 0, unknowns = 0;
  std::vector<ParameterInfo> parameters;
  std::vector<ObservableInfo> observables;
  std::string effective_case;  ///< its sections of the case as JSON, defaults included
  std::string failure;
  TETHER_FIELDS(protocol_version, role, program, host, pid, has_tangent, has_operators, has_state, state_size, unknowns,
                parameters, observables, effective_case, failure)
};

// ---- master -> any partner ------------------------------------------------------------------------------------------

/// Answer to Hello. -> Ready
struct Welcome {
  std::int64_t protocol_version = version;
  std::string host;
  std::int64_t pid = 0;
  std::string output;  ///< folder for the partner's files
  TETHER_FIELDS(protocol_version, host, pid, output)
};
/// -> Interface
struct GetInterface {
  TETHER_FIELDS()
};
/// -> Ready
struct SetParameters {
  std::vector<std::string> names;
  std::vector<double> values;
  TETHER_FIELDS(names, values)
};
/// -> State
struct GetState {
  TETHER_FIELDS()
};
/// -> Ready
struct SetState {
  std::vector<double> values;
  TETHER_FIELDS(values)
};
/// Start the step from `time` to `time + dt`; predicted: the interface displacement expected at its end. -> Ready
struct BeginStep {
  double time = 0, dt = 0;
  std::vector<double> predicted;
  TETHER_FIELDS(time, dt, predicted)
};
/// Keep what the last evaluation found, or return to the state before BeginStep (also when BeginStep or an evaluation
/// failed, or no evaluation came). -> StepReport
struct EndStep {
  bool accepted = true;
  TETHER_FIELDS(accepted)
};
/// Write files for viewing under the output folder. -> Ready
struct Write {
  std::int64_t step = 0;
  double time = 0;
  TETHER_FIELDS(step, time)
};
/// What the partner has cost so far, for the summary. -> Usage
struct GetUsage {
  TETHER_FIELDS()
};
/// Finish: write what is open, answer, end. -> Ready
struct Stop {
  std::string reason;
  TETHER_FIELDS(reason)
};

// ---- master -> fluid ------------------------------------------------------------------------------------------------

/// Interface displacement and velocity (y1 - y0)/dt at the end of the step. -> Load
struct FluidEvaluate {
  std::vector<double> displacement, velocity;
  TETHER_FIELDS(displacement, velocity)
};
/// The same, linearised at the last evaluation. -> Load (the change of the load)
struct FluidTangent {
  std::vector<double> velocity_change;
  TETHER_FIELDS(velocity_change)
};

// ---- master -> solid ------------------------------------------------------------------------------------------------

/// Nodal forces on the interface: solve the step. -> Motion
struct SolidEvaluate {
  std::vector<double> load;
  TETHER_FIELDS(load)
};
/// The same, linearised at the last evaluation. -> Motion (the change of the motion)
struct SolidTangent {
  std::vector<double> load_change;
  TETHER_FIELDS(load_change)
};
/// Add `correction` (empty: none) to the iterate V of all unknowns, then return the residual of the step's equations under
/// `load`. After BeginStep the iterate's interface part is (predicted - y0)/dt, the rest the solid's own prediction.
/// Unknowns: interface velocities first, in interface order. -> SolidResidualReply
struct SolidResidual {
  std::vector<double> correction, load;
  TETHER_FIELDS(correction, load)
};
/// Tangent of the residual (with a plus sign: symmetric positive definite) times a direction. -> Unknowns
struct SolidProduct {
  std::vector<double> direction;
  TETHER_FIELDS(direction)
};
/// An approximate inverse of that tangent times a residual; zero where the solid's motion is prescribed. -> Unknowns
struct SolidPrecondition {
  std::vector<double> residual;
  TETHER_FIELDS(residual)
};

// ---- master -> observation_manager ----------------------------------------------------------------------------------

/// The moving surface at a time. -> Discrepancy
struct Observe {
  double time = 0;
  std::vector<double> points;
  TETHER_FIELDS(time, points)
};

// ---- partner -> master, as replies ----------------------------------------------------------------------------------

struct Ready {
  TETHER_FIELDS()
};
/// What went wrong; the partner stays reachable and can still answer GetState.
struct Failure {
  std::string message;
  bool input_wrong = false;  ///< the user's input, not the run
  TETHER_FIELDS(message, input_wrong)
};
struct Interface {
  std::vector<double> points;            ///< reference positions
  std::vector<std::int64_t> triangles;   ///< three node indices each, normals out of the fluid
  std::vector<std::string> region_names; ///< of the outer wall; empty for a fluid
  std::vector<std::int64_t> regions;     ///< a region per triangle, -1 for none; may be empty
  TETHER_FIELDS(points, triangles, region_names, regions)
};
struct State {
  std::vector<double> values;
  TETHER_FIELDS(values)
};
struct StepReport {
  std::vector<double> observables;  ///< as announced in Hello
  TETHER_FIELDS(observables)
};
struct Load {
  std::vector<double> forces;
  TETHER_FIELDS(forces)
};
struct Motion {
  std::vector<double> displacement, velocity;  ///< velocity: (y1 - y0)/dt
  TETHER_FIELDS(displacement, velocity)
};
struct SolidResidualReply {
  std::vector<double> residual;  ///< all unknowns: load - internal, inertial and support forces
  std::vector<double> displacement, velocity;  ///< of the interface, at the iterate
  TETHER_FIELDS(residual, displacement, velocity)
};
struct Unknowns {
  std::vector<double> values;
  TETHER_FIELDS(values)
};
struct Discrepancy {
  std::vector<double> distances, normals, weights;
  TETHER_FIELDS(distances, normals, weights)
};
struct Usage {
  double cpu_seconds = 0, peak_memory_mb = 0;  ///< user and system time; largest resident set
  TETHER_FIELDS(cpu_seconds, peak_memory_mb)
};

#undef TETHER_FIELDS

using ToPartner = std::variant<Welcome, GetInterface, SetParameters, GetState, SetState, BeginStep, EndStep, Write, Stop,
                               FluidEvaluate, FluidTangent, SolidEvaluate, SolidTangent, SolidResidual, SolidProduct,
                               SolidPrecondition, Observe, GetUsage>;
using ToMaster = std::variant<Hello, Ready, Failure, Interface, State, StepReport, Load, Motion, SolidResidualReply,
                              Unknowns, Discrepancy, Usage>;

}  // namespace tether::protocol
