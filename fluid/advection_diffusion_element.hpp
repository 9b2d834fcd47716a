#pragma once

#include "fluid/geometry.hpp"
#include "fluid/stabilisation.hpp"

namespace tether::fluid {

/// What one element knows when the advection-diffusion stage begins.
struct ElementFlow {
  Nodal velocity;        ///< v~0 at the nodes
  Nodal mesh_velocity;   ///< w at the nodes
  Nodal acceleration;    ///< f at the nodes: body force per mass, zero without one
  Vec3 carried;          ///< (dt_0/rho_0) grad p0, so that v0 = v~0 - carried (F.3)
  double viscosity = 0;  ///< mu
};

/// One element's share of the stage's matrix (the same for the three components) and right-hand side.
struct ElementSystem {
  Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix;
  Nodal rhs;
};

/// (F.4) on one P1 tetrahedron, integrated exactly (the SUPG test function with the mean of a), a = v0 - w:
///   matrix_ab = int phi_a (rho/dt + rho/2 div v0) phi_b + rho phi_a a.grad phi_b + mu grad phi_a.grad phi_b
///             + tau (a.grad phi_a) rho (phi_b/dt + div v0/2 phi_b + a.grad phi_b)
///   rhs_a     = int rho/dt (phi_a + tau a.grad phi_a) (v0 + dt f)
inline ElementSystem advection_diffusion(const TetGeometry& g, const ElementFlow& flow, double rho, double dt) {
  const double V = g.volume;
  const Nodal a = (flow.velocity - flow.mesh_velocity).colwise() - flow.carried;
  const Vec3 a_sum = a.rowwise().sum();
  const double divergence = flow.velocity.cwiseProduct(g.grad_N).sum();
  const double tau = supg_time(dt, a_sum.norm() / 4, element_size(V), flow.viscosity / rho);
  const Eigen::Vector4d along = g.grad_N.transpose() * a_sum / 4;  // mean a . grad phi_a
  const double growth = 1 / dt + divergence / 2;

  ElementSystem result;
  const Nodal advecting = (rho * V / 20) * (a.colwise() + a_sum);
  result.matrix.noalias() = advecting.transpose() * g.grad_N;
  result.matrix.noalias() += (flow.viscosity * V) * g.grad_N.transpose() * g.grad_N;
  result.matrix.noalias() += (tau * rho * V) * along * (along.array() + growth / 4).matrix().transpose();
  result.matrix.array() += rho * growth * V / 20;
  result.matrix.diagonal().array() += rho * growth * V / 20;

  const Nodal driven = flow.velocity + dt * flow.acceleration;
  const Vec3 driven_sum = driven.rowwise().sum();
  const Vec3 v0_mean = driven_sum / 4 - flow.carried;
  result.rhs = (rho / dt * V) * (((driven.colwise() + driven_sum) / 20).colwise() - flow.carried / 4 +
                                 tau * v0_mean * along.transpose());
  return result;
}

}  // namespace tether::fluid
