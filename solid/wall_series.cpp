#include "solid/wall_series.hpp"

#include <Eigen/Eigenvalues>

#include "common/base/error.hpp"
#include "common/io/vtu_writer.hpp"
#include "solid/wall_stress.hpp"

namespace tether {
namespace {

std::vector<Field> stress_fields(const Eigen::Matrix<double, 6, Eigen::Dynamic>& stress) {
  const Eigen::Index count = stress.cols();
  VectorXd principal(count);
  std::vector<double> tensors;
  for (Eigen::Index e = 0; e < count; ++e) {
    const Mat3 s = stress_tensor(stress.col(e));
    principal[e] = Eigen::SelfAdjointEigenSolver<Mat3>(s, Eigen::EigenvaluesOnly).eigenvalues()[2];
    const auto values = s.reshaped();
    tensors.insert(tensors.end(), values.begin(), values.end());
  }
  return {{"stress", 9, std::move(tensors)},
          Field::scalars("von_mises", von_mises(stress)),
          Field::scalars("largest_principal_stress", principal)};
}

}  // namespace

void WallSeries::write(const WallModel& model, const SolidSolver& solver,
                       const Eigen::Matrix<double, 6, Eigen::Dynamic>& stress, int step, double time) {
  if (!series_) {  // only then: an output that is removed in mid-run is not made anew
    series_ = PvdSeries::rescued_before(folder_ / "solid.pvd", time);
    std::filesystem::create_directories(folder_ / "vtk");
  }
  const std::string file = fmt::format("vtk/solid_{:06}.vtu", step);
  const Points& reference = model.mesh().points;
  write_vtu(folder_ / file, reference, cells_of(model.mesh()),
            {Field::vectors("displacement", solver.displacement()), Field::vectors("velocity", solver.velocity())},
            stress_fields(stress));
  series_->add(time, file);
}

}  // namespace tether
