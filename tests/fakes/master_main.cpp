#include <cmath>
#include <cstdio>
#include <thread>

#include "common/base/process.hpp"
#include "common/protocol/run.hpp"
#include "tests/fakes/misbehave.hpp"

using namespace tether;
using namespace tether::protocol;

/// One time step of a fixed-point coupling; returns the largest interface displacement.
double step(Partner& fluid, Partner& solid, std::int64_t number, Motion& motion) {
  const BeginStep begin{number, 0.01 * static_cast<double>(number), 0.01, motion.displacement};
  fluid.send(begin);
  solid.send(begin);
  fluid.receive<Ready>();
  solid.receive<Ready>();
  for (int i = 0; i < 20; ++i) {
    const Load load = fluid.ask(FluidEvaluate{motion.displacement, motion.velocity});
    motion = solid.ask(SolidEvaluate{load.forces});
  }
  fluid.ask(EndStep{true});
  solid.ask(EndStep{true});
  double largest = 0;
  for (const double y : motion.displacement) largest = std::max(largest, std::abs(y));
  return largest;
}

/// A small master of two fakes: fake_master FLUID SOLID STEPS.
int main(int argc, char** argv) {
  return run_master("fake_master", [&](Session& session) {
    if (argc != 4) throw input_error("usage: fake_master FLUID SOLID STEPS");
    auto partners = session.launch({{"fluid", argv[1], {"case.yaml"}}, {"solid", argv[2], {"case.yaml"}}}, "out");
    Partner &fluid = partners[0], &solid = partners[1];
    fluid.hello();
    solid.hello();
    const std::size_t size = fluid.ask(GetInterface{}).points.size();
    Motion motion{std::vector<double>(size), std::vector<double>(size)};
    std::printf("master %ld fluid %ld solid %ld\n", process_id(), fluid.peer().pid, solid.peer().pid);
    for (int n = 0; n < std::atoi(argv[3]); ++n) {
      std::printf("step %d %.15g\n", n, step(fluid, solid, n, motion));
      std::fflush(stdout);
      fakes::misbehave("master", "step" + std::to_string(n));
    }
    fluid.stop("done");
    solid.stop("done");
  });
}
