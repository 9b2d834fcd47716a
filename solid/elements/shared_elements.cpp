#include "solid/elements/shared_elements.hpp"

#include <utility>

namespace tether {

SharedElements::SharedElements(const Share& share, std::unique_ptr<WallElements> held, std::vector<int> numbers,
                               std::vector<char> answers, std::size_t count)
    : share_(share),
      held_(std::move(held)),
      numbers_(std::move(numbers)),
      answers_(std::move(answers)),
      count_(count) {}

void SharedElements::static_force(const Points& x, const Material& material, VectorXd& force,
                                  SparseMatrix* tangent) const {
  VectorXd here = VectorXd::Zero(force.size());
  held_->static_force(x, material, here, tangent);
  add(std::move(here), force);
}

void SharedElements::step_force(const StepMotion& motion, const WallMaterial& material, VectorXd& force,
                                SparseMatrix* tangent) const {
  VectorXd here = VectorXd::Zero(force.size());
  held_->step_force(motion, material, here, tangent);
  add(std::move(here), force);
}

VectorXd SharedElements::energies(const Points& x, const Material& material) const {
  return of_all(held_->energies(x, material).transpose()).transpose();
}

VectorXd SharedElements::volumes() const {
  return of_all(held_->volumes().transpose()).transpose();
}

Eigen::Matrix<double, 6, Eigen::Dynamic> SharedElements::cauchy_stress(const Points& x,
                                                                       const Material& material) const {
  return of_all(held_->cauchy_stress(x, material));
}

SparseMatrix SharedElements::zero_matrix() const {
  return held_->zero_matrix();
}

void SharedElements::set_initial_stress(const Points& u, const Material& material) {
  held_->set_initial_stress(u, material);
}

void SharedElements::set_places(std::vector<ElementPlace> places) {
  std::vector<ElementPlace> here;
  for (const int number : numbers_) here.push_back(places[static_cast<std::size_t>(number)]);
  held_->set_places(std::move(here));
}

void SharedElements::set_local(std::vector<WallLocal> regions) {
  held_->set_local(std::move(regions));
}

VectorXd SharedElements::tension_force(const Points& x) const {
  VectorXd force = held_->tension_force(x);
  share_.complete(force);
  return force;
}

void SharedElements::add(VectorXd here, VectorXd& force) const {
  share_.complete(here);
  force += here;
}

Eigen::MatrixXd SharedElements::of_all(const Eigen::MatrixXd& held) const {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(held.rows(), static_cast<Eigen::Index>(count_));
  for (std::size_t i = 0; i < numbers_.size(); ++i)
    if (answers_[i] != 0) all.col(numbers_[i]) = held.col(static_cast<Eigen::Index>(i));
  share_.team().sum({all.data(), static_cast<std::size_t>(all.size())});
  return all;
}

}  // namespace tether
