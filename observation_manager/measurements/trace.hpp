#pragma once

#include <optional>

#include "common/base/curve.hpp"
#include "common/config/case_file.hpp"
#include "observation_manager/measurements/measurement.hpp"
#include "observation_manager/measurements/trace_case.hpp"

namespace tether {

/// A measured value beside the run's.
struct TraceValue {
  double time = 0, measured = 0, model = 0;  ///< time: in the run
};

/// A measured pressure or flow, to be compared with a column of timeseries.csv.
class Trace : public Measurement {
 public:
  /// times, values: as measured. tolerance: how far from its ends a time still is one of the trace.
  Trace(std::string name, std::string observable, std::vector<double> times, std::vector<double> values, Curve curve,
        Noise noise, double period = 0, double tolerance = 0, bool held_out = false, Dimension dimension = {},
        double zero = 0);

  /// Linear between the values; nothing before the first or after the last, unless it repeats.
  std::optional<double> at(double time) const;
  /// The values that a run reaches, in the order of the run's times.
  std::vector<TraceValue> beside(const RunTrace& run) const;

  MeasurementFacts facts() const override;
  std::uint64_t content() const override;
  std::vector<NeededColumn> columns() const override { return {{observable, "observable", dimension}}; }
  std::vector<MeasuredPart> parts(const FinishedMotion& run) const override;
  std::vector<Datum> data(const FinishedMotion& run, const MeasuredPart& part) const override;
  CountedRows rows(const Points& imaged, double start) const override;
  std::vector<SeenRow> see(const ModelMoment& model, double time) const override;

  std::string name, observable;
  std::vector<double> times, values;  ///< as measured; pressures relative to the image's
  Curve curve;
  Noise noise;
  double period = 0;      ///< 0: it does not repeat [time]
  double tolerance = 0;   ///< how far from its ends a time still is one of the trace [time]
  bool held_out = false;  ///< it judges the model, and is not used to make it
  Dimension dimension = {};
  double zero = 0;  ///< of the instrument, to which the values are relative
};

/// Reads it. Throws InputError "file:line: ...".
Trace load_trace(const std::string& name, const TraceCase& given, const CaseFile& file);

}  // namespace tether
