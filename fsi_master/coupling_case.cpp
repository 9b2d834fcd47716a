#include "fsi_master/coupling_case.hpp"

namespace tether {

void CouplingCase::Programs::declare(Fields& f) {
  f.text("fluid", fluid, "the program that solves the blood flow");
  f.text("solid", solid, "the program that solves the wall");
  f.text("observation", observation, "the program that measures the distance to the data, if the observer is on");
}

void CouplingCase::declare(Fields& f) {
  f.choice("method", method,
           {{"automatic", "newton_krylov if both codes announce tangents, else iqn_ils"},
            {"newton_krylov", "Newton with the tangents of both codes"},
            {"iqn_ils", "interface quasi-Newton, for codes that offer nothing but their answer"}},
           "how each step's interface velocity is found");
  f.number("tolerance", tolerance, dimension::none, {0, 0.1, true, false},
           "residual of the interface velocity relative to it at which a step is done");
  f.integer("max_iterations", max_iterations, {1, 1000}, "evaluations of fluid and wall before a step is given up");
  f.integer("reuse", reuse, {0, 100}, "iqn_ils: earlier steps whose differences are kept");
  f.integer("halvings", halvings, {0, 10}, "times that a step which fails may be halved");
  f.choice("mapping", mapping,
           {{"match", "the interface meshes agree node for node"},
            {"nearest_triangle",
             "each fluid node follows the closest point of the wall's triangles; forces and work are kept"}},
           "how the interface of the fluid follows that of the wall");
  f.number(
      "mapping_distance", mapping_distance, dimension::length, range::positive,
      "farthest that a fluid node may be from its counterpart; if absent 1e-5 (match) or 0.02 (nearest_triangle) of "
      "the interface's diagonal");
  f.group("programs", programs, "executables; a name without slash is looked for beside fsi_master");
}

}  // namespace tether
