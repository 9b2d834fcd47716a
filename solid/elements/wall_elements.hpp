#pragma once

#include <memory>

#include "common/base/types.hpp"
#include "common/linalg/share.hpp"
#include "common/linalg/sparse.hpp"
#include "common/mesh/mesh.hpp"
#include "solid/elements/wall_local.hpp"
#include "solid/materials/material.hpp"

namespace tether {

/// How a step moves the wall. Positions and velocities: one column a node.
struct StepMotion {
  const Points& start;         ///< positions at the beginning of the step
  const Points& velocity;      ///< V = (end - start)/dt
  const Points& acceleration;  ///< (V - u0)/(theta dt)
  double theta, dt;
  bool conserve_energy;  ///< discrete gradient between start and end (theta = 1/2), else the stress at start + theta dt
                         ///< V
};

/// What a wall element is made of.
struct WallMaterial {
  const Material* elastic;
  double viscosity;  ///< eta_s: S += eta_s de/dt [pressure time]
  double density;    ///< [mass/volume], of the stress-free wall
};

/// All elements of the wall, of one kind, built on the stress-free positions. Forces and matrices are by node, then x y
/// z. Where several processes share the wall, forces are whole in each, and of a matrix the rows of its own nodes.
class WallElements {
 public:
  virtual ~WallElements() = default;

  /// Force that the wall exerts against static positions x: f = dPhi/dx (S.2); tangent, if not null, += df/dx (S.3).
  virtual void static_force(const Points& x, const Material& material, VectorXd& force,
                            SparseMatrix* tangent) const = 0;
  /// The same in a time step (S.5), viscosity and inertia included; tangent, if not null, += df/dV.
  virtual void step_force(const StepMotion& motion, const WallMaterial& material, VectorXd& force,
                          SparseMatrix* tangent) const = 0;
  /// Of each element.
  virtual VectorXd energies(const Points& x, const Material& material) const = 0;
  double energy(const Points& x, const Material& material) const { return energies(x, material).sum(); }
  /// Of each element, without stress.
  virtual VectorXd volumes() const = 0;
  double volume() const { return volumes().sum(); }
  /// Cauchy stress of each element, averaged over its points: columns 11 22 33 12 23 13.
  virtual Eigen::Matrix<double, 6, Eigen::Dynamic> cauchy_stress(const Points& x, const Material& material) const = 0;
  virtual SparseMatrix zero_matrix() const = 0;
  /// From now on the elements carry, beside what the material answers to their strain, the stress of a linear elastic
  /// wall of this material displaced by u from its reference (S.14); u: one column a node.
  virtual void set_initial_stress(const Points& u, const Material& material) = 0;
  /// Where the elements are, one a cell: before `set_local`.
  virtual void set_places(std::vector<ElementPlace> places) = 0;
  /// In what the regions of the wall differ, one entry a region (S.19). Takes effect at once.
  virtual void set_local(std::vector<WallLocal> regions) = 0;
  /// Force of the tension along the vessel alone, at positions x.
  virtual VectorXd tension_force(const Points& x) const = 0;
};

/// Prisms if the mesh has them, otherwise linear tetrahedra. `reference`: stress-free positions. Throws RunError naming
/// an element that has no volume.
std::unique_ptr<WallElements> make_wall_elements(const WallMesh& mesh, const Points& reference);
/// The same for the processes of a team, each of which holds the elements at its own nodes; `share`, of the mesh's
/// nodes, must outlive them.
std::unique_ptr<WallElements> make_wall_elements(const WallMesh& mesh, const Points& reference, const Share& share);

}  // namespace tether
