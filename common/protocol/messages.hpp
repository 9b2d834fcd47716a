#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

/// The messages between a master and its partners (fluid, solid, observation_manager). Plain structs, one variant a
/// direction. Each lists its fields once, in `fields`: that is the order on the wire (docs/protocol.md). Arrays of
/// vectors are node by node: x0 y0 z0 x1 y1 z1 ..., nodes in the order of the partner's `Interface` message. Every
/// request names its one `Reply`; a partner may always answer `Failure` instead.
namespace tether::protocol {

inline constexpr std::int64_t version = 2;

#define TETHER_FIELDS(...)              \
  template <class Archive>              \
  void fields(Archive& archive) {       \
    archive(__VA_ARGS__);               \
  }                                     \
  template <class Archive>              \
  void fields(Archive& archive) const { \
    archive(__VA_ARGS__);               \
  }

/// The name that errors and the conformance check use, and the fields in wire order.
#define TETHER_MESSAGE(Name, ...)                    \
  static constexpr const char* message_name = #Name; \
  TETHER_FIELDS(__VA_ARGS__)

/// A number of the partner that the master may set by name.
struct ParameterInfo {
  std::string name, meaning, unit, transform;
  double value = 0, absent = 0, lower = 0, upper = 0;  ///< absent: NaN if there is no such value
  double prior_deviation = 0;                          ///< NaN if undefined
  double scale = 0;  ///< how far from `absent` the value of a patient may be; NaN if undefined
  TETHER_FIELDS(name, meaning, unit, transform, value, absent, lower, upper, prior_deviation, scale)
};

/// A scalar that the partner reports after every accepted step, such as "outlet.flow" in cm3/s.
struct ObservableInfo {
  std::string name, unit;
  TETHER_FIELDS(name, unit)
};

// ---- partner -> master, once, unasked -------------------------------------------------------------------------------

/// The first message, sent as soon as the partner has reached MPI and before it reads its case: from now on the master
/// notices its death. The master answers with Welcome.
struct Arrival {
  std::int64_t protocol_version = version;
  std::string role;  ///< "fluid", "solid", "solid_observation", "fsi_master"
  std::string host;
  std::int64_t pid = 0;
  TETHER_MESSAGE(Arrival, protocol_version, role, host, pid)
};
/// The second message, when the case is read and the partner is ready for requests; or Failure if that did not work,
/// and the partner ends.
struct Hello {
  std::string program;         ///< name and version, for the summary
  bool has_tangent = false;    ///< answers FluidTangent / SolidTangent
  bool has_operators = false;  ///< solid: answers SolidResidual, SolidProduct, SolidPrecondition
  bool has_state = false;      ///< answers GetState, SetState
  bool has_observer = false;   ///< solid: answers Correct, Withdraw; fluid: MoveInterface
  bool has_velocity = false;   ///< fluid: answers GetVelocity
  std::int64_t state_size = 0, unknowns = 0;
  std::vector<ParameterInfo> parameters;
  std::vector<ObservableInfo> observables;
  std::string effective_case;             ///< its sections of the case as JSON, defaults included
  std::vector<std::string> notices = {};  ///< what a person should know before the run, a sentence each
  TETHER_MESSAGE(Hello, program, has_tangent, has_operators, has_state, has_observer, has_velocity, state_size,
                 unknowns, parameters, observables, effective_case, notices)
};

// ---- partner -> master, as replies ----------------------------------------------------------------------------------

struct Ready {
  TETHER_MESSAGE(Ready)
};
/// What went wrong; the partner stays reachable and can still answer GetState.
struct Failure {
  std::string message;
  bool input_wrong = false;  ///< the user's input, not the run
  TETHER_MESSAGE(Failure, message, input_wrong)
};
struct Interface {
  std::vector<double> points;             ///< reference positions
  std::vector<std::int64_t> triangles;    ///< three node indices each, normals out of the fluid
  std::vector<std::string> region_names;  ///< of the outer wall; empty for a fluid
  std::vector<std::int64_t> regions;      ///< a region per triangle, -1 for none; may be empty
  TETHER_MESSAGE(Interface, points, triangles, region_names, regions)
};
struct State {
  std::vector<double> values;
  TETHER_MESSAGE(State, values)
};
struct StepReport {
  std::vector<double> observables;  ///< as announced in Hello
  TETHER_MESSAGE(StepReport, observables)
};
struct Load {
  std::vector<double> forces;
  TETHER_MESSAGE(Load, forces)
};
struct Motion {
  std::vector<double> displacement, velocity;  ///< velocity: (y1 - y0)/dt
  TETHER_MESSAGE(Motion, displacement, velocity)
};
struct SolidResidualReply {
  std::vector<double> residual;                ///< all unknowns: load - internal, inertial and support forces
  std::vector<double> displacement, velocity;  ///< of the interface, at the iterate
  TETHER_MESSAGE(SolidResidualReply, residual, displacement, velocity)
};
struct Unknowns {
  std::vector<double> values;
  TETHER_MESSAGE(Unknowns, values)
};
/// How far the data are from the surface, at places of it (samples), always as many and in the same order.
struct Discrepancy {
  std::vector<double> distances;         ///< positive where the data lie outside
  std::vector<double> normals;           ///< three a sample: distance times normal leads from the model to the data
  std::vector<double> weights;           ///< area or length that a sample stands for; 0: no observation
  std::vector<std::int64_t> nodes;       ///< three a sample, which may be the same: the place is the sum of
  std::vector<double> shares;            ///< three a sample, times the nodes' positions
  std::vector<std::int64_t> sources;     ///< which data
  std::vector<std::int64_t> exclusions;  ///< why there is no observation; 0: there is one
  TETHER_MESSAGE(Discrepancy, distances, normals, weights, nodes, shares, sources, exclusions)
};
/// How far a correction moved the interface.
struct Correction {
  std::vector<double> displacement;  ///< or its rate, for a drift
  TETHER_MESSAGE(Correction, displacement)
};
/// The blood's velocity at points of space.
struct Velocity {
  std::vector<double> values;  ///< three a point; NaN outside the lumen
  TETHER_MESSAGE(Velocity, values)
};
/// Where a particle is after a step, and what it would have measured.
struct Advanced {
  std::vector<double> state, memory;       ///< as Advance has them
  std::vector<double> observables;         ///< as announced in Hello
  std::vector<double> distances, weights;  ///< of Discrepancy, sample by sample; empty if not asked for
  std::vector<double> velocities;          ///< three a point that the case measures it at; NaN outside the lumen
  std::int64_t evaluations = 0, krylov_iterations = 0, parts = 0;
  TETHER_MESSAGE(Advanced, state, memory, observables, distances, weights, velocities, evaluations, krylov_iterations,
                 parts)
};
/// How a whole run ended.
struct Simulated {
  std::string failure;           ///< why it ended before its end; empty: it did not
  std::int64_t evaluations = 0;  ///< of fluid and solid together, over all steps
  TETHER_MESSAGE(Simulated, failure, evaluations)
};
/// A run that was ordered has ended.
struct RunEnded {
  std::string folder;            ///< as it was ordered
  std::string failure;           ///< as Simulated has it
  bool made = false;             ///< now; else it was there
  std::int64_t evaluations = 0;  ///< as Simulated has them
  double cpu_seconds = 0;        ///< of all processes that made it
  TETHER_MESSAGE(RunEnded, folder, failure, made, evaluations, cpu_seconds)
};
struct Usage {
  double cpu_seconds = 0, peak_memory_mb = 0;  ///< user and system time; largest resident set
  TETHER_MESSAGE(Usage, cpu_seconds, peak_memory_mb)
};

// ---- master -> any partner ------------------------------------------------------------------------------------------

/// Answer to Arrival; the partner now watches its master. No reply: Hello follows.
struct Welcome {
  std::int64_t protocol_version = version;
  std::string host;
  std::int64_t pid = 0;
  std::string output;  ///< folder for the partner's files
  TETHER_MESSAGE(Welcome, protocol_version, host, pid, output)
};
/// The reference surface, before the first step.
struct GetInterface {
  using Reply = Interface;
  TETHER_MESSAGE(GetInterface)
};
/// Give named numbers of Hello's list new values, from the next step on. An unknown name is a Failure that changes
/// nothing.
struct SetParameters {
  using Reply = Ready;
  std::vector<std::string> names;
  std::vector<double> values;
  TETHER_MESSAGE(SetParameters, names, values)
};
/// Everything needed to continue from the end of the last accepted step.
struct GetState {
  using Reply = State;
  TETHER_MESSAGE(GetState)
};
/// Continue from such a state.
struct SetState {
  using Reply = Ready;
  std::vector<double> values;
  TETHER_MESSAGE(SetState, values)
};
/// Start the step from `time` to `time + dt`; predicted: the interface displacement expected at its end.
struct BeginStep {
  using Reply = Ready;
  std::int64_t step = 0;  ///< its number, for messages to people
  double time = 0, dt = 0;
  std::vector<double> predicted;
  TETHER_MESSAGE(BeginStep, step, time, dt, predicted)
};
/// Keep what the last evaluation found, or return to the state before BeginStep (also when BeginStep or an evaluation
/// failed, or no evaluation came).
struct EndStep {
  using Reply = StepReport;
  bool accepted = true;
  TETHER_MESSAGE(EndStep, accepted)
};
/// Write files for viewing under the output folder.
struct Write {
  using Reply = Ready;
  std::int64_t step = 0;
  double time = 0;
  TETHER_MESSAGE(Write, step, time)
};
/// What the partner has cost so far, for the summary.
struct GetUsage {
  using Reply = Usage;
  TETHER_MESSAGE(GetUsage)
};
/// Finish: write what is open, answer, end.
struct Stop {
  using Reply = Ready;
  std::string reason;
  bool abrupt = false;  ///< the job has failed: end right after the answer, without MPI_Finalize
  TETHER_MESSAGE(Stop, reason, abrupt)
};

// ---- master -> fluid ------------------------------------------------------------------------------------------------

/// Interface displacement and velocity (y1 - y0)/dt at the end of the step.
struct FluidEvaluate {
  using Reply = Load;
  std::vector<double> displacement, velocity;
  TETHER_MESSAGE(FluidEvaluate, displacement, velocity)
};
/// The same, linearised at the last evaluation; the reply is the change of the load.
struct FluidTangent {
  using Reply = Load;
  std::vector<double> velocity_change;
  TETHER_MESSAGE(FluidTangent, velocity_change)
};

/// The velocity at points of space, where the mesh stands after the last accepted step.
struct GetVelocity {
  using Reply = Velocity;
  std::vector<double> points;
  TETHER_MESSAGE(GetVelocity, points)
};

// ---- master -> solid ------------------------------------------------------------------------------------------------

/// Nodal forces on the interface: solve the step.
struct SolidEvaluate {
  using Reply = Motion;
  std::vector<double> load;
  TETHER_MESSAGE(SolidEvaluate, load)
};
/// The same, linearised at the last evaluation; the reply is the change of the motion.
struct SolidTangent {
  using Reply = Motion;
  std::vector<double> load_change;
  TETHER_MESSAGE(SolidTangent, load_change)
};
/// Add `correction` (empty: none) to the iterate V of all unknowns, then return the residual of the step's equations
/// under `load`. After BeginStep the iterate's interface part is (predicted - y0)/dt, the rest the solid's own
/// prediction. Unknowns: interface velocities first, in interface order.
struct SolidResidual {
  using Reply = SolidResidualReply;
  std::vector<double> correction, load;
  TETHER_MESSAGE(SolidResidual, correction, load)
};
/// Tangent of the residual (with a plus sign: symmetric positive definite) times a direction.
struct SolidProduct {
  using Reply = Unknowns;
  std::vector<double> direction;
  TETHER_MESSAGE(SolidProduct, direction)
};
/// An approximate inverse of that tangent times a residual; zero where the solid's motion is prescribed.
struct SolidPrecondition {
  using Reply = Unknowns;
  std::vector<double> residual;
  TETHER_MESSAGE(SolidPrecondition, residual)
};

// ---- state observer: master -> solid, fluid that announce it (Hello.has_observer)
// --------------------------------------

/// Distances from the interface's nodes to the data, along normals, and the areas they stand for (0: no observation).
/// The wall moves toward them by what its gain makes of `dt`, at once, between two steps; or, `drift`, it moves with
/// the rate that its gain makes of them during the step begun.
struct Correct {
  using Reply = Correction;
  double dt = 0;
  bool drift = false;
  std::vector<double> weights, distances, normals;
  TETHER_MESSAGE(Correct, dt, drift, weights, distances, normals)
};
/// Take this share of the last correction back.
struct Withdraw {
  using Reply = Ready;
  double share = 1;
  TETHER_MESSAGE(Withdraw, share)
};
/// To a fluid, between two steps: the interface and the mesh have moved, the fields with them; nothing has flowed. A
/// Failure (a mesh that would break) changes nothing.
struct MoveInterface {
  using Reply = Ready;
  std::vector<double> displacement;  ///< its change
  TETHER_MESSAGE(MoveInterface, displacement)
};

// ---- master -> observation_manager ----------------------------------------------------------------------------------

/// The moving surface at a time: positions of the interface's nodes.
struct Observe {
  using Reply = Discrepancy;
  double time = 0;
  std::vector<double> points;
  TETHER_MESSAGE(Observe, time, points)
};

// ---- identification_master -> fsi_master ----------------------------------------------------------------------------

/// One step of one particle, from `time` to `time + dt`, with these parameters. A group holds nothing of a particle
/// between two steps: any group may take any particle.
struct Advance {
  using Reply = Advanced;
  std::int64_t step = 0;  ///< its number, for messages to people
  double time = 0, dt = 0;
  bool observe = false;            ///< take distances and velocities at the end
  std::vector<std::string> names;  ///< of parameters,
  std::vector<double> values;
  std::vector<double> state;   ///< as State or Advanced had it; states may be averaged
  std::vector<double> memory;  ///< what the coupling method remembers: for its speed only; may be empty
  TETHER_MESSAGE(Advance, step, time, dt, observe, names, values, state, memory)
};
/// A whole run from the initial state with these parameters: timeseries.csv and lumen.motion in `output`. Its steps
/// begin as those of the guide, a run of the same case with other values, changed: that saves work, and changes what
/// the coupling's tolerance leaves open. The guide itself is told so by its own folder.
struct Simulate {
  using Reply = Simulated;
  std::vector<std::string> names;
  std::vector<double> values;
  std::int64_t steps = 0;
  std::string output;
  std::string guide;  ///< folder of that run; empty: none
  TETHER_MESSAGE(Simulate, names, values, steps, output, guide)
};

// ---- tether -> identification_master that serves runs ---------------------------------------------------------------

/// A run that is wanted: its folder, and numbers of the model that differ from the case.
struct RunOrder {
  std::string folder;
  std::vector<std::string> names;
  std::vector<double> values;
  TETHER_FIELDS(folder, names, values)
};
/// Make these runs, as soon as groups are free, those first that were ordered first. What a folder holds of the same
/// case and the same values is not made again.
struct OrderRuns {
  using Reply = Ready;
  std::vector<RunOrder> runs;
  std::string guide;  ///< of all of them, as Simulate has it; it must have ended before others begin
  TETHER_MESSAGE(OrderRuns, runs, guide)
};
/// Wait for the next run that ends, whichever it is: each that was ordered is answered once.
struct NextRun {
  using Reply = RunEnded;
  TETHER_MESSAGE(NextRun)
};

#undef TETHER_MESSAGE
#undef TETHER_FIELDS

/// Any message in one direction. Its index here is its MPI tag.
using ToPartner = std::variant<Welcome, GetInterface, SetParameters, GetState, SetState, BeginStep, EndStep, Write,
                               Stop, FluidEvaluate, FluidTangent, SolidEvaluate, SolidTangent, SolidResidual,
                               SolidProduct, SolidPrecondition, Observe, GetUsage, Correct, Withdraw, MoveInterface,
                               GetVelocity, Advance, Simulate, OrderRuns, NextRun>;
using ToMaster =
    std::variant<Arrival, Hello, Ready, Failure, Interface, State, StepReport, Load, Motion, SolidResidualReply,
                 Unknowns, Discrepancy, Usage, Correction, Velocity, Advanced, Simulated, RunEnded>;

/// What each role must be able to answer: a handler for each is asked for at compile time (serve.hpp, which answers
/// GetUsage itself).
using ToFluid = std::variant<GetInterface, SetParameters, GetState, SetState, BeginStep, EndStep, Write, Stop,
                             FluidEvaluate, FluidTangent>;
using ToSolid = std::variant<GetInterface, SetParameters, GetState, SetState, BeginStep, EndStep, Write, Stop,
                             SolidEvaluate, SolidTangent, SolidResidual, SolidProduct, SolidPrecondition>;
/// The same with a state observer, and of a fluid that tells its velocity.
using ToObservedFluid = std::variant<GetInterface, SetParameters, GetState, SetState, BeginStep, EndStep, Write, Stop,
                                     FluidEvaluate, FluidTangent, MoveInterface, GetVelocity>;
using ToObservedSolid =
    std::variant<GetInterface, SetParameters, GetState, SetState, BeginStep, EndStep, Write, Stop, SolidEvaluate,
                 SolidTangent, SolidResidual, SolidProduct, SolidPrecondition, Correct, Withdraw>;
/// To an fsi_master that is a partner itself. It answers GetUsage for its whole group.
using ToGroup = std::variant<GetInterface, SetParameters, GetState, SetState, Write, Stop, Advance, Simulate, GetUsage>;
/// To an identification_master that serves runs. Its Hello is that of the model.
using ToRunService = std::variant<OrderRuns, NextRun, Stop>;
/// A manager of measurements of the lumen.
using ToObservation = std::variant<SetParameters, Write, Stop, Observe>;

}  // namespace tether::protocol
