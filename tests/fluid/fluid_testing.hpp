#pragma once

#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <string>

#include "fluid/fluid_solver.hpp"
#include "tests/mesh/box.hpp"
#include "vessel/sweep.hpp"

/// Meshes, runs and norms that the fluid's tests share.
namespace tether::fluid::testing {

/// A box along z: walls at x and y, an outlet at the top, an inlet at the bottom (or a wall there, if closed).
inline FluidMesh box_vessel(const Vec3& size, const std::array<int, 3>& cells, bool closed = false) {
  const BoxMesh box = box_mesh(size, cells);
  FluidMesh mesh{box.points, box.tetrahedra, {}, {}, {}};
  for (std::size_t side : {0u, 1u, 2u, 3u}) {
    const auto& triangles = box.sides[side].triangles;
    mesh.interface.insert(mesh.interface.end(), triangles.begin(), triangles.end());
  }
  const auto& bottom = box.sides[4].triangles;
  if (closed)
    mesh.interface.insert(mesh.interface.end(), bottom.begin(), bottom.end());
  else
    mesh.inlets.push_back({"inlet", bottom});
  mesh.outlets.push_back({"outlet", box.sides[5].triangles});
  return mesh;
}

inline FluidMesh tube(double radius, double length, int around, int along) {
  return circular_tube(radius, length, 0.1 * radius, around, along).fluid;
}

/// Blood of density rho and viscosity mu; inlet flow Q(t) = 1, outlet at pressure 0.
inline FluidSettings settings(double rho, double mu) {
  FluidSettings result;
  result.blood.values["density"] = rho;
  result.rheology = {"newtonian", {{"viscosity", mu}}};
  result.inlets["inlet"].curve = Curve::constant(1);
  result.outlets["outlet"].effect = {"pressure", {}};
  result.linear_tolerance = 1e-11;
  return result;
}

inline Points zero_on_sigma(const FluidSolver& solver) {
  return Points::Zero(3, static_cast<Eigen::Index>(solver.domain().sigma.nodes.size()));
}

/// One step with the interface moving as told (displacement at the end; velocity V over the step). Returns the load.
inline Points step(FluidSolver& solver, double time, double dt, const Points& displacement, const Points& velocity) {
  solver.begin_step(time, dt, displacement);
  Points load = solver.evaluate(displacement, velocity);
  solver.accept();
  return load;
}

/// Steps with a wall that does not move. Returns the last load.
inline Points run_rigid(FluidSolver& solver, double dt, int steps, double start = 0) {
  const Points zero = zero_on_sigma(solver);
  Points load;
  for (int n = 0; n < steps; ++n) load = step(solver, start + n * dt, dt, zero, zero);
  return load;
}

/// The value an observable had at the last step.
inline double observed(const FluidSolver& solver, const std::string& name) {
  for (std::size_t i = 0; i < solver.observables().size(); ++i)
    if (solver.observables()[i].name == name) return solver.observed()[static_cast<Eigen::Index>(i)];
  throw std::out_of_range(name);
}

using VectorField = std::function<Vec3(const Vec3&)>;
using ScalarField = std::function<double(const Vec3&)>;

/// The solver now starts from these fields, as if reached by a step dt.
inline void start_from(FluidSolver& solver, double dt, double rho, const VectorField& velocity,
                       const ScalarField& pressure) {
  const int n = solver.domain().node_count();
  VectorXd state = solver.state();
  state[0] = dt / rho;
  for (int node = 0; node < n; ++node) {
    const Vec3 x = solver.domain().mesh().points.col(node);
    state.segment<3>(2 + 3 * node) = velocity(x);
    state[2 + 3 * n + node] = pressure(x);
  }
  solver.set_state(state);
}

/// sqrt(int |v_h - exact|^2) over the reference mesh, by the four-point rule of degree 2.
inline double l2_error(const FluidDomain& domain, const Points& v, const VectorField& exact) {
  constexpr double near = 0.58541019662496845446, far = 0.13819660112501051518;
  double sum = 0;
  for (const auto& tet : domain.tetrahedra()) {
    const Nodal x = gather(domain.mesh().points, tet), values = gather(v, tet);
    const double volume = tet_geometry(x).volume;
    for (int q = 0; q < 4; ++q) {
      Eigen::Vector4d N = Eigen::Vector4d::Constant(far);
      N[q] = near;
      sum += volume / 4 * (values * N - exact(x * N)).squaredNorm();
    }
  }
  return std::sqrt(sum);
}

inline double l2_error(const FluidDomain& domain, const VectorXd& p, const ScalarField& exact) {
  const Points as_vector = Vec3::UnitX() * p.transpose();
  return l2_error(domain, as_vector, [&](const Vec3& x) -> Vec3 { return {exact(x), 0, 0}; });
}

inline double order(double coarse, double fine, double refinement = 2) {
  return std::log(coarse / fine) / std::log(refinement);
}

/// One line of the table in docs/verification.md: an error on two meshes or steps, and the order between them.
inline void report(const std::string& what, double coarse, double fine, double refinement = 2) {
  std::printf("| %s | %.3g | %.3g | %.2f |\n", what.c_str(), coarse, fine, order(coarse, fine, refinement));
}

inline Points random_points(Eigen::Index count, double size, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  Points result(3, count);
  for (double& x : result.reshaped()) x = uniform(generator);
  return result;
}

}  // namespace tether::fluid::testing
