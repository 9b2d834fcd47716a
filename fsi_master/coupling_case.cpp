#include "fsi_master/coupling_case.hpp"

namespace tether {

void CouplingCase::Programs::declare(Fields& f) {
  f.program("fluid", fluid, "the program that solves the blood flow");
  f.program("solid", solid, "the program that solves the wall");
  f.program("observation", observation, "the program that measures the distance to the data, if the observer is on");
}

void CouplingCase::Ranks::declare(Fields& f) {
  f.integer("fluid", fluid, {1, 4096}, "that solve the blood flow together: each has its part of the mesh");
  f.integer("solid", solid, {1, 4096}, "that solve the wall together");
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
  f.choice(
      "mapping", mapping,
      {{"automatic", "match if the interface meshes agree node for node and triangle for triangle, else mortar"},
       {"match", "they must agree node for node"},
       {"mortar",
        "the fluid's motion is that of the wall in the mean around each node; the load comes back as the traction "
        "that it stands for. Force, moment and work are kept"},
       {"nearest_triangle",
        "each fluid node follows the closest place of the wall's triangles. Force, moment and work are kept, but a "
        "load is only where a fluid node is"}},
      "how the interface of the fluid follows that of the wall");
  f.number(
      "mapping_distance", mapping_distance, dimension::length, range::positive,
      "farthest that a fluid node may be from the wall; if absent 0.02 of the interface's diagonal, and 1e-5 of it "
      "where nodes must match");
  f.group("programs", programs,
          "executables; a name without slash is one of Tether's own, a path is relative to the case file");
  f.choice("processes", processes,
           {{"apart", "fluid and solid are processes of their own"},
            {"together",
             "what of them is Tether's own is in the master's process: a small model takes two fifths less of the "
             "processor's time, a large one does not have both at work at once"}},
           "of a direct run; the groups of an identification and of a diagnosis have them together");
  f.group("ranks", ranks, "processes of a program; on an mpirun line its -n says it");
}

}  // namespace tether
