#include <cstdio>

#include "common/config/case_file.hpp"
#include "common/protocol/run.hpp"
#include "vessel/mesh_case.hpp"

using namespace tether;
using namespace tether::protocol;

/// A small master that asks the real observation_manager about the imaged lumen: ask_observation PROGRAM CASE TIME
/// [NODES]. Prints one line a sample: distance, weight, exclusion. NODES: sends so many nodes instead of the lumen's.
int main(int argc, char** argv) {
  return run_master("ask_observation", [&](Session& session) {
    if (argc < 4) throw input_error("usage: ask_observation PROGRAM CASE TIME [NODES]");
    auto partners = session.launch({{"solid_observation", argv[1], {argv[2]}}}, "out");
    Partner& manager = partners.front();
    std::printf("%s\n", manager.hello().program.c_str());
    CaseFile file(argv[2]);
    MeshCase mesh;
    file.read("mesh", mesh);
    const WallMesh wall = load_mesh(mesh, file, WallElement::prism).wall;
    std::vector<double> points(wall.points.data(), wall.points.data() + 3 * wall.interface_nodes);
    if (argc > 4) points.resize(3 * static_cast<std::size_t>(std::atoi(argv[4])));
    const Discrepancy found = manager.ask(Observe{std::atof(argv[3]), points});
    for (std::size_t i = 0; i < found.distances.size(); ++i)
      std::printf("%.17g %.17g %ld\n", found.distances[i], found.weights[i], found.exclusions[i]);
    manager.stop("asked");
  });
}
