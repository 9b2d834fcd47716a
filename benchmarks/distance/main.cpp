#include <algorithm>
#include <cstdio>
#include <vector>

#include "common/base/process.hpp"
#include "observation_manager/measurements/signed_surface.hpp"
#include "tests/observation_manager/shapes.hpp"

/// What signed distances cost: 6,000 points of a model's surface to 12,000 triangles of a measured one, of two frames.
namespace tether {
namespace {

constexpr int repetitions = 21;

/// Least and median processor time of `work` [ms].
template <class Work>
void measure(const char* what, Work work) {
  std::vector<double> times;
  for (int i = 0; i < repetitions; ++i) {
    const double before = cpu_seconds();
    work();
    times.push_back(1e3 * (cpu_seconds() - before));
  }
  std::sort(times.begin(), times.end());
  std::printf("%-52s %7.2f ms (least), %7.2f ms (median)\n", what, times.front(), times[repetitions / 2]);
}

TriangleSurface vessel(int around, int along, double radius) {
  return testing::tube(around, along, 20, [radius](double z) { return radius + 0.1 * std::sin(z); });
}

void run() {
  const Points model = vessel(75, 79, 1.0).points;
  const TriangleSurface first = vessel(100, 60, 1.05), second = vessel(100, 60, 1.1);
  std::printf("%d points, %zu triangles, processor time\n", static_cast<int>(model.cols()), first.triangles.size());
  measure("trees and pseudonormals of two frames", [&] { const SignedSurface a(first), b(second); });
  const SignedSurface a(first), b(second);
  measure("signed distances of all points to one frame", [&] { a.closest(model); });
  measure("signed distances of all points to both frames", [&] { a.closest(model), b.closest(model); });
  std::vector<Neighbourhood> known;
  int look = 0;
  measure("the same points to one frame, moved by 0.001 a look", [&] {
    a.closest((model.array() + 0.001 * (++look % 20)).matrix(), known);  // triangles are 0.06 by 0.33 wide
  });
  measure("both trees and both distances", [&] {
    const SignedSurface c(first), d(second);
    c.closest(model), d.closest(model);
  });
}

}  // namespace
}  // namespace tether

int main() {
  tether::prepare_process();
  tether::run();
}
