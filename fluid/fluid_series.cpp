#include "fluid/fluid_series.hpp"

#include <fmt/format.h>

#include "common/io/vtu_writer.hpp"

namespace tether::fluid {

void FluidSeries::write(const FluidSolver& solver, int step, double time) {
  if (!series_) {  // only then: an output that is removed in mid-run is not made anew
    series_ = PvdSeries::rescued_before(folder_ / "fluid.pvd", time);
    std::filesystem::create_directories(folder_ / "vtk");
  }
  const std::string file = fmt::format("vtk/fluid_{:06}.vtu", step);
  const FluidMesh& mesh = solver.domain().mesh();
  write_vtu(folder_ / file, mesh.points, cells_of(mesh),
            {Field::vectors("displacement", solver.mesh_displacement()), Field::vectors("velocity", solver.velocity()),
             Field::scalars("pressure", solver.pressure())});
  series_->add(time, file);
}

}  // namespace tether::fluid
