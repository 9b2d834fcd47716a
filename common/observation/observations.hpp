#pragma once

#include <memory>

#include "common/base/curve.hpp"
#include "common/config/case_file.hpp"
#include "common/observation/lumen_series.hpp"
#include "common/observation/observation_case.hpp"

namespace tether {

/// A measured pressure or flow, to be compared with a column of timeseries.csv.
struct Trace {
  std::string name, observable;
  std::vector<double> times, values;  ///< as measured; pressures relative to the image's
  Curve curve;
  Noise noise;
  double period = 0;  ///< 0: it does not repeat [time]
};

/// All that was measured of a case.
struct Observations {
  std::vector<std::unique_ptr<LumenSeries>> lumen;
  std::vector<Trace> traces;

  /// The samples of all lumen data at a time, sources one after the other.
  std::vector<Sample> observe(const Points& x, double time) const;
  /// What was found and done on loading: "cine_mr: ..."
  std::vector<std::string> notes() const;
};

/// Reads and checks everything. Throws InputError that names the file, or the field of the case.
Observations load_observations(const ObservationsCase& given, const LumenSurface& lumen, const CaseFile& file);

}  // namespace tether
