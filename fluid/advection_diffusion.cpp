#include "fluid/advection_diffusion.hpp"

#include "fluid/advection_diffusion_element.hpp"

namespace tether::fluid {
namespace {

constexpr int max_iterations = 500;

Eigen::Index as_index(std::size_t i) {
  return static_cast<Eigen::Index>(i);
}

/// Mean of v0 - w over a boundary triangle, through it: (v~0 - carried - w).N. (F.7) element: behind it, of those held.
double relative_flux(const StageInput& input, const Surface& face, std::size_t t, int element) {
  const auto& tri = face.triangles[t];
  Vec3 mean = Vec3::Zero();
  for (int local : tri) {
    const int node = face.nodes[static_cast<std::size_t>(local)];
    mean += (input.velocity.col(node) - input.mesh_velocity.col(node)) / 3;
  }
  return (mean - input.carried.col(element)).dot(face.area_vectors.col(as_index(t)));
}

/// For each node of a tetrahedron, whether it lies on a triangle of its face.
Eigen::Vector4d on_triangle(const Tetrahedron& tet, const Surface& face, std::size_t t) {
  Eigen::Vector4d result = Eigen::Vector4d::Zero();
  for (int local : face.triangles[t])
    for (std::size_t a = 0; a < 4; ++a)
      if (tet[a] == face.nodes[static_cast<std::size_t>(local)]) result[as_index(a)] = 1;
  return result;
}

}  // namespace

AdvectionDiffusion::AdvectionDiffusion(const FluidDomain& domain, std::vector<int> fixed_nodes)
    : fixed_(std::move(fixed_nodes)),
      map_(domain.node_count(), 1, std::span<const Tetrahedron>(domain.tetrahedra())),
      matrix_(map_.zero_matrix()),
      rhs_(3, domain.node_count()),
      viscosity_(as_index(domain.tetrahedra().size())) {
  if (!domain.share().is_whole()) own_.emplace(domain.share(), matrix_);
}

KrylovResult AdvectionDiffusion::solve(const FluidDomain& domain, const StageInput& input, double tolerance,
                                       Points& velocity) {
  update_viscosity(domain, input);
  assemble(domain, input);
  add_backflow(domain, input);
  if (!input.rheology.is_constant()) add_viscosity_gradient(domain, input);
  prescribe(velocity);
  if (own_) return solve_shared(domain.share(), tolerance, velocity);
  preconditioner_.factor(matrix_);
  return bicgstab(matrix_, preconditioner_, rhs_, velocity, tolerance, max_iterations);
}

/// Each process preconditions by the incomplete factors of its own block.
KrylovResult AdvectionDiffusion::solve_shared(const Share& share, double tolerance, Points& velocity) {
  own_->take(matrix_);
  share.team().each([this] { preconditioner_.factor(own_->block()); });
  Points x = own_->all_of(velocity);
  const KrylovResult result = bicgstab(*own_, preconditioner_, own_->own_of(rhs_), x, tolerance, max_iterations);
  own_->put_back(x, velocity);
  share.complete(velocity);
  return result;
}

void AdvectionDiffusion::update_viscosity(const FluidDomain& domain, const StageInput& input) {
  if (input.rheology.is_constant()) {
    viscosity_.setConstant(input.rheology.viscosity(0));
    return;
  }
  for (std::size_t e = 0; e < domain.tetrahedra().size(); ++e) {
    const Mat3 grad_v = velocity_gradient(domain.geometry()[e], gather(input.velocity, domain.tetrahedra()[e]));
    viscosity_[as_index(e)] = input.rheology.viscosity(shear_rate(grad_v));
  }
}

void AdvectionDiffusion::assemble(const FluidDomain& domain, const StageInput& input) {
  std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
  rhs_.setZero();
  ElementFlow flow;
  flow.acceleration.setZero();
  for (std::size_t e = 0; e < domain.tetrahedra().size(); ++e) {
    const auto& tet = domain.tetrahedra()[e];
    flow.velocity = gather(input.velocity, tet);
    flow.mesh_velocity = gather(input.mesh_velocity, tet);
    if (input.acceleration.size() > 0) flow.acceleration = gather(input.acceleration, tet);
    flow.carried = input.carried.col(as_index(e));
    flow.viscosity = viscosity_[as_index(e)];
    const ElementSystem system = advection_diffusion(domain.geometry()[e], flow, input.density, input.dt);
    map_.add(matrix_, e, system.matrix.data());
    for (int a = 0; a < 4; ++a) rhs_.col(tet[static_cast<std::size_t>(a)]) += system.rhs.col(a);
  }
}

/// (F.7): beta rho |min(0, a.n)| v~ phi over the open faces: what enters where blood should leave brings no energy.
void AdvectionDiffusion::add_backflow(const FluidDomain& domain, const StageInput& input) {
  if (input.backflow == 0) return;
  for (const Surface* face : input.open)
    for (std::size_t t = 0; t < face->triangles.size(); ++t) {
      const int element = domain.place_of(face->tetrahedra[t]);
      if (element < 0) continue;
      const double entering = -relative_flux(input, *face, t, element);
      if (entering <= 0) continue;
      const auto e = static_cast<std::size_t>(element);
      const Eigen::Vector4d on = on_triangle(domain.tetrahedra()[e], *face, t);
      Eigen::Matrix<double, 4, 4, Eigen::RowMajor> block = on * on.transpose();
      block.diagonal() += on;
      block *= input.backflow * input.density * entering / 12;
      map_.add(matrix_, e, block.data());
    }
}

/// (F.6), of the previous velocity: - (mu ((grad v)' - div v), grad phi) and, over the open faces, its boundary term.
/// Together they vanish for one viscosity; the condition left at the open faces is mu dv/dn = 0, that of a developed
/// flow.
void AdvectionDiffusion::add_viscosity_gradient(const FluidDomain& domain, const StageInput& input) {
  const auto stress = [&](std::size_t e) -> Mat3 {
    const Mat3 grad_v = velocity_gradient(domain.geometry()[e], gather(input.velocity, domain.tetrahedra()[e]));
    return viscosity_[as_index(e)] * (grad_v.transpose() - grad_v.trace() * Mat3::Identity());
  };
  for (std::size_t e = 0; e < domain.tetrahedra().size(); ++e) {
    const Nodal force = stress(e) * domain.geometry()[e].grad_N * domain.geometry()[e].volume;
    for (int a = 0; a < 4; ++a) rhs_.col(domain.tetrahedra()[e][static_cast<std::size_t>(a)]) -= force.col(a);
  }
  for (const Surface* face : input.open)
    for (std::size_t t = 0; t < face->triangles.size(); ++t) {
      const int element = domain.place_of(face->tetrahedra[t]);
      if (element < 0) continue;
      const Vec3 traction = stress(static_cast<std::size_t>(element)) * face->area_vectors.col(as_index(t));
      for (int local : face->triangles[t]) rhs_.col(face->nodes[static_cast<std::size_t>(local)]) += traction / 3;
    }
}

/// Rows of the fixed nodes become diagonal: diagonal * v~ = diagonal * prescribed, which keeps the rows' sizes alike.
void AdvectionDiffusion::prescribe(const Points& velocity) {
  for (int node : fixed_) {
    double diagonal = 0;
    for (SparseMatrix::InnerIterator entry(matrix_, node); entry; ++entry) {
      if (entry.col() == node)
        diagonal = entry.value();
      else
        entry.valueRef() = 0;
    }
    rhs_.col(node) = diagonal * velocity.col(node);
  }
}

}  // namespace tether::fluid
