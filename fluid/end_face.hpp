#pragma once

#include <Eigen/SparseCore>

#include <complex>
#include <memory>
#include <string>

#include "fluid/surface.hpp"

namespace tether::fluid {

/// An inlet or outlet: a surface with a rim on Sigma, and the P1 Laplacian on it, in the reference mesh.
/// It tells how the face's inner nodes follow the rim, and what a developed flow through it looks like.
class EndFace : public Surface {
 public:
  /// sigma_nodes: ascending. Throws InputError if the face has no rim on Sigma or no node inside it.
  EndFace(const Patch& patch, const FluidMesh& mesh, const std::vector<int>& sigma_nodes);
  ~EndFace();
  EndFace(EndFace&&) noexcept;

  std::string name;
  std::vector<int> rim, inner;  ///< local nodes

  /// Fills the inner columns of a local field by the harmonic extension of its rim columns. (F.1)
  void extend_from_rim(Points& field) const;
  /// Local psi of - laplace psi + alpha psi = 1, psi = 0 on the rim: a paraboloid on a circle for alpha = 0,
  /// Womersley's profile for alpha = i omega rho / mu. (F.12)
  Eigen::VectorXcd developed_profile(std::complex<double> alpha) const;
  /// int psi dA in the reference mesh.
  std::complex<double> integral(const Eigen::VectorXcd& psi) const;

 private:
  struct Extension;
  Eigen::SparseMatrix<double> stiffness_, mass_;
  VectorXd lumped_;
  std::unique_ptr<Extension> extension_;
};

}  // namespace tether::fluid
