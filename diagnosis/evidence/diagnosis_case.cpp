#include "diagnosis/evidence/diagnosis_case.hpp"

namespace tether {

void DiagnosisCase::declare(Fields& f) {
  f.texts("candidates", candidates, "types of effects that may be missing; absent: all of the catalogue");
  f.texts(
      "also", also,
      "what is a candidate beside the catalogue: generic types that it leaves out, such as moving_tissue, and faults "
      "of instruments: value_offset, value_scale, value_lag");
  f.texts("exclude", exclude, "what is no candidate: types, parts of the wall, or numbers by their place in the case");
  f.texts("assumed", assumed,
          "numbers of the model, by their place in the case, that may be anything: effects must show beyond them");
  f.number("step", step, dimension::none, {0, 1, true, false},
           "by how much of its scale an effect is switched on to see what it would do");
  f.number("alpha", alpha, dimension::none, {0, 0.5, true, true}, "probability of a false alarm over all candidates");
  f.number("unexplained", unexplained, dimension::none, {0, 1},
           "share of what the data ask for beyond noise; if more remains, something else is missing");
  f.integer("most", most, {1, 20}, "effects that are added at most, one after the other");
  f.integer("refinements", refinements, {1, 20}, "runs at most to find an effect's amplitude");
  f.integer("confirmed", confirmed, {1, 100}, "candidates whose amplitude is found with runs before one is chosen");
  f.group("allowed", allowed, "errors of data, inputs and mesh that are no news: standard deviations");
  f.choice("numerics", numerics,
           {{"where_needed", "for a swept mesh that is as coarse as one may be: no coarser one tells what it does"},
            {"true", "always"},
            {"false", "never: the mesh is known to be fine enough"}},
           "whether half the time step, and of a swept mesh twice the elements around and along, compete with the "
           "effects: two runs that cost some six others, and where the mesh is as coarse as one may be, a few of what "
           "leads on the finer mesh");
  f.flag(
      "coarse", coarse,
      "whether what each number does to first order is found with twice the time step, and on a swept mesh with half "
      "the elements around and along; what is probable is run with the model itself");
}

}  // namespace tether
