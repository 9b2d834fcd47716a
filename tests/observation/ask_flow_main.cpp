#include <cstdio>

#include "common/protocol/run.hpp"

using namespace tether;
using namespace tether::protocol;

/// A small master of the real observation_manager in its other role: ask_flow_observation PROGRAM CASE. Prints its
/// sources and places, then, for a pressure of 100 and velocities (10, 0, 0) at 0.5, one line a sample: difference,
/// deviation, source, exclusion.
int main(int argc, char** argv) {
  return run_master("ask_flow_observation", [&](Session& session) {
    if (argc < 3) throw input_error("usage: ask_flow_observation PROGRAM CASE");
    auto partners = session.launch({{"fluid_observation", argv[1], {argv[2], "--role", "fluid_observation"}}}, "out");
    Partner& manager = partners.front();
    for (const ObservableInfo& source : manager.hello().observables)
      std::printf("%s [%s]\n", source.name.c_str(), source.unit.c_str());
    const std::vector<double> places = manager.ask(GetInterface{}).points;
    std::vector<double> velocities(places.size(), 0.0);
    for (std::size_t i = 0; i < places.size(); i += 3) {
      std::printf("place %g %g %g\n", places[i], places[i + 1], places[i + 2]);
      velocities[i] = 10;
    }
    const FlowDiscrepancy found = manager.ask(ObserveFlow{0.5, {"fluid.outlet.pressure"}, {100}, velocities});
    for (std::size_t i = 0; i < found.differences.size(); ++i)
      std::printf("%g %g %ld %ld\n", found.differences[i], found.deviations[i], found.sources[i], found.exclusions[i]);
    manager.stop("asked");
  });
}
