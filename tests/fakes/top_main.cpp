#include <cstdio>

#include "common/protocol/run.hpp"

using namespace tether::protocol;

/// A master of two groups, each a master of a fluid and a solid: three levels, seven processes. Both groups work at the
/// same time and must give the same.
int main() {
  return run_master("identification_master", [](Session& session) {
    const Program group{"fsi_master", "fake_group", {}};
    const std::span<Partner> groups = session.launch({group, group}, "out");
    for (Partner& partner : groups) partner.hello();
    for (int step = 0; step < 3; ++step) {
      for (Partner& partner : groups) partner.send(Observe{0.01 * step, std::vector<double>(54)});
      const auto first = groups[0].receive<Discrepancy>(), second = groups[1].receive<Discrepancy>();
      if (first.distances != second.distances) throw tether::run_error("the groups differ");
      std::printf("step %d %.15g\n", step, first.distances[0]);
    }
    for (Partner& partner : groups) partner.stop("done");
  });
}
