#include "solid/wall_series.hpp"

#include <Eigen/Eigenvalues>

#include "common/base/error.hpp"
#include "common/io/vtu_writer.hpp"

namespace tether {
namespace {

Mat3 tensor(const Voigt& s) {
  Mat3 m;
  m << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  return m;
}

std::vector<Field> stress_fields(const Eigen::Matrix<double, 6, Eigen::Dynamic>& stress) {
  const Eigen::Index count = stress.cols();
  VectorXd mises(count), principal(count);
  std::vector<double> tensors;
  for (Eigen::Index e = 0; e < count; ++e) {
    const Mat3 s = tensor(stress.col(e));
    const Mat3 deviator = s - s.trace() / 3 * Mat3::Identity();
    mises[e] = std::sqrt(1.5) * deviator.norm();
    principal[e] = Eigen::SelfAdjointEigenSolver<Mat3>(s, Eigen::EigenvaluesOnly).eigenvalues()[2];
    const auto values = s.reshaped();
    tensors.insert(tensors.end(), values.begin(), values.end());
  }
  return {{"stress", 9, std::move(tensors)},
          Field::scalars("von_mises", mises),
          Field::scalars("largest_principal_stress", principal)};
}

}  // namespace

void WallSeries::write(const WallModel& model, const SolidSolver& solver, int step, double time) {
  if (!series_) series_ = PvdSeries::resumed(folder_ / "solid.pvd", time * (1 - 1e-12) - 1e-300);
  const std::string file = fmt::format("vtk/solid_{:06}.vtu", step);
  std::filesystem::create_directories(folder_ / "vtk");
  const Points& reference = model.mesh().points;
  const auto stress = model.elements().cauchy_stress(reference + solver.displacement(), model.material());
  write_vtu(folder_ / file, reference, cells_of(model.mesh()),
            {Field::vectors("displacement", solver.displacement()), Field::vectors("velocity", solver.velocity())},
            stress_fields(stress));
  series_->add(time, file);
}

}  // namespace tether
