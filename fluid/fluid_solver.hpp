#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/base/mark.hpp"
#include "common/base/parameter_table.hpp"
#include "fluid/advection_diffusion.hpp"
#include "fluid/fluid_domain.hpp"
#include "fluid/openings.hpp"
#include "fluid/probe.hpp"
#include "fluid/projection.hpp"
#include "fluid/section.hpp"
#include "fluid/settings.hpp"

namespace tether::fluid {

/// A number reported after every accepted step, such as "outlet.flow".
struct Observable {
  std::string name;
  Dimension dimension;
};

/// Blood in a moving vessel: ALE Navier-Stokes by Chorin-Temam's splitting, P1/P1 (docs/equations.md, section F).
/// One step: begin_step once, evaluate and tangent as often as the coupling needs, then accept or rewind.
/// Arrays on the interface have one column a node of Sigma, in ascending order of the fluid mesh's nodes. The processes
/// of a team call the same functions with the same arguments, and each has the whole answer.
class FluidSolver {
 public:
  /// Throws InputError if mesh and settings do not fit.
  FluidSolver(FluidMesh mesh, const FluidSettings& settings, Team& team = alone());
  FluidSolver(const FluidSolver&) = delete;
  FluidSolver& operator=(const FluidSolver&) = delete;

  const FluidDomain& domain() const { return domain_; }

  /// The explicit stage, from `time` to time + dt: mesh, advection-diffusion, and all of the projection but its
  /// right-hand side. predicted: displacement of the interface expected at the end. Throws RunError if the mesh folds
  /// or a solve fails; the accepted state is untouched.
  void begin_step(double time, double dt, const Points& predicted);
  /// The projection stage: forces of the blood on the wall's nodes, for the interface displacement y1 and its velocity
  /// V = (y1 - y0)/dt (not the wall's own end velocity). Flux and force are those through and on Sigma as it stands in
  /// the middle of the step, y1 - dt V/2: with the predicted Sigma, pressure drives flexible walls unstable at large
  /// steps (docs/decisions/0012-interface-geometry.md). (F.8) to (F.10)
  Points evaluate(const Points& displacement, const Points& velocity);
  /// Change of that load by a change of V, y1 moving with it: - B' (L + e e'/Z)^-1 B dV, symmetric negative
  /// semi-definite (F.11), and what the motion of Sigma does to flux and force: of the order of dt V over the radius,
  /// not symmetric.
  Points tangent(const Points& velocity_change) const;
  /// Keeps the last evaluation as the new state.
  void accept();
  /// Forgets the step begun.
  void rewind() { begun_ = evaluated_ = false; }

  /// Between two steps: Sigma, and the mesh with it, has moved by this, the fields with the nodes; nothing has flowed
  /// (F.15). Throws RunError if the mesh would fold; nothing has changed then.
  void move_interface(const Points& change);

  /// Everything needed to continue, bit for bit. A state of the same nodes with other openings, whose length may be
  /// another, is taken but for the pressures stored beyond them, which are the initial ones. Throws InputError for one
  /// of other nodes.
  VectorXd state() const;
  Eigen::Index state_size() const;
  void set_state(const VectorXd& values);
  /// Goes on as one does that takes the state now: nothing of earlier meshes is kept.
  void forget_earlier_meshes() { projection_.forget(); }

  /// All numbers that can be set, such as "fluid.outlets.outlet.distal_resistance".
  const ParameterTable& parameters() const { return parameters_; }
  /// Take effect at the next begin_step. Throws InputError for an unknown name or a value out of range; none is set
  /// then.
  void set_parameters(const std::vector<std::string>& names, const std::vector<double>& values);
  void set_parameter(const std::string& name, double value) { set_parameters({name}, {value}); }

  const std::vector<Observable>& observables() const { return observables_; }
  /// Of the last accepted step, in the order of `observables`.
  const VectorXd& observed() const { return observed_; }

  /// Fields of the last accepted step at all nodes, for output: v~, p, and the mesh's displacement.
  const Points& velocity() const { return accepted_.velocity; }
  const VectorXd& pressure() const { return accepted_.pressure; }
  const Points& mesh_displacement() const { return accepted_.displacement; }

 private:
  /// What the next step starts from. Fields after `derived` follow from those before.
  struct Accepted {
    Points velocity;     // v~0
    VectorXd pressure;   // p0
    Points on_sigma;     // the predicted displacement of Sigma that placed the mesh
    VectorXd stored;     // a pressure for each opening
    double impulse = 0;  // dt_0/rho_0; 0 before the first step
    double volume = 0;   // of the lumen with the interface where it was accepted
    // derived
    Points displacement;  // d0, all nodes
    Points carried;       // impulse * grad p0, one column an element (F.3)
  };
  /// The step under way.
  struct Trial {
    double end_time = 0, dt = 0;
    Points on_sigma, displacement, mesh_velocity;  // predicted; d1; w
    Points velocity;                               // v~
    VectorXd rhs;                                  // of the projection, without the interface's part
    VectorXd known;                                // of each opening
    std::vector<OutletInput> inputs;
    std::vector<Points> profiles;  // of each flow inlet, u_in
    double inflow = 0, swept = 0;  // through the flow inlets, in space; by the end faces' own motion, outward
    std::vector<SectionCut> cuts;  // of the sections, on the mesh as the step has it
    Points viscous_load;
    double wall_shear = 0;  // mean over Sigma
    // of the last evaluation
    Points interface_displacement;
    double interface_flux = 0;
    VectorXd wall_pressure;  // on Sigma, offset included
    Points wall_points;      // Sigma in the middle of the step
    Points wall_velocity;    // V
    Projection::Solution solution;
    double volume = 0;  // of the lumen at the step's end; known once it is observed
  };

  void declare_parameters();
  void declare_observables();
  void store_initial_pressures();
  Mark mark_of_openings() const;

  void move_mesh();
  void cut_sections();
  void predict_velocity();
  void prepare_projection();
  Points acceleration() const;
  /// Of the blood on the wall, by its viscosity: on each triangle of Sigma [3 x t].
  Points viscous_forces() const;
  double kinematic_viscosity() const;
  void observe();
  void observe_sections(std::vector<double>& values) const;
  void derive(Accepted& state);

  FluidDomain domain_;
  Configured<Blood> blood_;
  Configured<Rheology> rheology_;
  std::vector<FlowInlet> flow_inlets_;
  std::vector<Opening> openings_;
  std::vector<const Surface*> open_faces_;
  std::vector<Probe> probes_;
  std::vector<Section> sections_;
  std::function<Vec3(const Vec3&, double)> body_acceleration_;
  double linear_tolerance_;

  AdvectionDiffusion advection_diffusion_;
  Projection projection_;

  Mark nodes_, beyond_;  ///< of the mesh, and of what kind is beyond which opening
  Accepted accepted_;
  Trial trial_;
  bool begun_ = false, evaluated_ = false;
  ParameterTable parameters_;
  std::vector<Observable> observables_;
  VectorXd observed_;
};

}  // namespace tether::fluid
