#pragma once

#include <memory>
#include <vector>

#include "solid/elements/wall_elements.hpp"

namespace tether {

/// Those at a process's own nodes; what is whole is put together from all. The share must outlive them.
class SharedElements final : public WallElements {
 public:
  /// numbers: in the mesh, of the elements held, ascending; answers: for which of them this process does; count: of
  /// all.
  SharedElements(const Share& share, std::unique_ptr<WallElements> held, std::vector<int> numbers,
                 std::vector<char> answers, std::size_t count);

  void static_force(const Points& x, const Material& material, VectorXd& force, SparseMatrix* tangent) const override;
  void step_force(const StepMotion& motion, const WallMaterial& material, VectorXd& force,
                  SparseMatrix* tangent) const override;
  VectorXd energies(const Points& x, const Material& material) const override;
  VectorXd volumes() const override;
  Eigen::Matrix<double, 6, Eigen::Dynamic> cauchy_stress(const Points& x, const Material& material) const override;
  SparseMatrix zero_matrix() const override;
  void set_initial_stress(const Points& u, const Material& material) override;
  void set_places(std::vector<ElementPlace> places) override;
  void set_local(std::vector<WallLocal> regions) override;
  VectorXd tension_force(const Points& x) const override;

 private:
  void add(VectorXd here, VectorXd& force) const;
  /// A column an element: of those held, and of all.
  Eigen::MatrixXd of_all(const Eigen::MatrixXd& held) const;

  const Share& share_;
  std::unique_ptr<WallElements> held_;
  std::vector<int> numbers_;
  std::vector<char> answers_;
  std::size_t count_;
};

}  // namespace tether
