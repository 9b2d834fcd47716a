#include "observation_manager/measurements/trace_case.hpp"

namespace tether {

void declare_quantity(Fields& f, std::string& quantity, Dimension& dimension) {
  f.choice("quantity", quantity,
           {{"pressure", "in the blood"},
            {"flow", "through an opening"},
            {"length", "a displacement, a diameter"},
            {"volume", "of the lumen"},
            {"force", "of a support"}},
           "what it is");
  const std::vector<std::pair<std::string_view, Dimension>> dimensions{{"pressure", dimension::pressure},
                                                                       {"flow", dimension::flow},
                                                                       {"length", dimension::length},
                                                                       {"volume", dimension::volume},
                                                                       {"force", dimension::force}};
  for (const auto& [word, of_word] : dimensions)
    if (quantity == word) dimension = of_word;
}

void TraceCase::declare(Fields& f) {
  f.text("observable", observable, "column of timeseries.csv: fluid.outlet.pressure", Need::required);
  declare_quantity(f, quantity, noise.dimension);
  curve.dimension = correction.dimension = noise.dimension;
  f.group("curve", curve, "the measured values over time");
  f.check(!curve.constant, "curve", "give a file: a constant is no measurement");
  f.number("time_shift", time_shift, dimension::time, range::any, "added to the data's times");
  f.when("quantity", quantity, {"pressure"}, [&] {
    f.flag("absolute", absolute, "the pressure of the image is subtracted, to which the run's pressures are relative");
  });
  f.flag("held_out", held_out, "the model never sees it: it judges");
  if (!correction.faults.empty()) f.group("correction", correction, "what is wrong with the values, taken off them");
  f.group("noise", noise, "errors of the values");
}

}  // namespace tether
