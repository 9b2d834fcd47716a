#pragma once

#include <optional>
#include <vector>

#include "fluid/bicgstab.hpp"
#include "fluid/fluid_domain.hpp"
#include "fluid/rheologies/rheology.hpp"

namespace tether::fluid {

/// The explicit stage's data: everything at the start of the step but the mesh and its velocity, which are the new
/// ones.
struct StageInput {
  double density = 0, dt = 0;
  double backflow = 0;  ///< beta in (F.7)
  const Rheology& rheology;
  const Points& velocity;                   ///< v~0, all nodes
  const Points& carried;                    ///< (dt_0/rho_0) grad p0, one column an element held (F.3)
  const Points& mesh_velocity;              ///< w, all nodes
  const Points& acceleration;               ///< f, all nodes; may be empty
  const std::vector<const Surface*>& open;  ///< faces where the velocity is free
};

/// Step 3 of the scheme: the predicted velocity v~ from (F.4), one matrix for its three components.
class AdvectionDiffusion {
 public:
  /// fixed_nodes: where the velocity is prescribed.
  AdvectionDiffusion(const FluidDomain& domain, std::vector<int> fixed_nodes);

  /// velocity, in: a guess, with the prescribed values at the fixed nodes; out: v~. `tolerance` of the residual is
  /// relative.
  KrylovResult solve(const FluidDomain& domain, const StageInput& input, double tolerance, Points& velocity);
  /// Viscosity of each element that this process holds in the last solve.
  const VectorXd& viscosity() const { return viscosity_; }

 private:
  void update_viscosity(const FluidDomain& domain, const StageInput& input);
  void assemble(const FluidDomain& domain, const StageInput& input);
  void add_backflow(const FluidDomain& domain, const StageInput& input);
  void add_viscosity_gradient(const FluidDomain& domain, const StageInput& input);
  void prescribe(const Points& velocity);
  KrylovResult solve_shared(const Share& share, double tolerance, Points& velocity);

  std::vector<int> fixed_;
  ScatterMap map_;
  SparseMatrix matrix_;
  Points rhs_;
  VectorXd viscosity_;
  std::optional<OwnRows> own_;  // where several processes share the matrix
  Ilu0 preconditioner_;
};

/// grad v of an element, (i, j) = dv_i/dx_j.
inline Mat3 velocity_gradient(const TetGeometry& g, const Nodal& velocity) {
  return velocity * g.grad_N.transpose();
}

/// gamma = sqrt(2 eps:eps). (F.14)
inline double shear_rate(const Mat3& gradient) {
  return std::sqrt(0.5) * (gradient + gradient.transpose()).norm();
}

}  // namespace tether::fluid
