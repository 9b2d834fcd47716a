/// What it costs to write a step for viewing: CPU milliseconds of a file, median of 21, by the size of the mesh.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "common/base/process.hpp"
#include "common/io/vtu_writer.hpp"
#include "vessel/sweep.hpp"

namespace {

using namespace tether;

double median_ms_of_writing(const VesselMesh& tube, const std::filesystem::path& file) {
  const VectorXd pressure = VectorXd::Ones(tube.fluid.points.cols());
  std::vector<double> times;
  for (int i = 0; i < 21; ++i) {
    const double start = cpu_seconds();
    write_vtu(file, tube.fluid.points, cells_of(tube.fluid),
              {Field::vectors("velocity", tube.fluid.points), Field::scalars("pressure", pressure)});
    times.push_back(1e3 * (cpu_seconds() - start));
  }
  std::nth_element(times.begin(), times.begin() + 10, times.end());
  return times[10];
}

}  // namespace

int main() {
  const auto file = std::filesystem::temp_directory_path() / "tether_files_benchmark.vtu";
  fmt::print("| nodes | tetrahedra | CPU ms | MB |\n|---|---|---|---|\n");
  for (const int around : {24, 60}) {  // 60 x 54: the mesh of the paper
    const VesselMesh tube = circular_tube(2, 10, 0.2, around, around * 9 / 10);
    const double ms = median_ms_of_writing(tube, file);
    fmt::print("| {} | {} | {:.1f} | {:.2f} |\n", tube.fluid.points.cols(), tube.fluid.tetrahedra.size(), ms,
               1e-6 * static_cast<double>(std::filesystem::file_size(file)));
  }
  std::filesystem::remove(file);
}
