#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/config/curve_case.hpp"
#include "common/config/fields.hpp"

namespace tether {

struct FlowCurveCase : CurveCase {
  FlowCurveCase() : CurveCase(dimension::flow) {}
};

struct PressureCurveCase : CurveCase {
  PressureCurveCase() : CurveCase(dimension::pressure) {}
};

/// The pressure that outlets are to make, where they are joined: absolute.
struct TargetPressureCase {
  std::optional<double> mean, pulse;
  std::optional<PressureCurveCase> curve;
  double venous = 0;
  std::optional<double> image;
  void declare(Fields& f);
};

/// How the flow is shared.
struct SplitCase {
  std::string by = "shares";
  double exponent = 3;
  void declare(Fields& f);
};

/// Resistances before the reservoirs.
struct ProximalCase {
  double share = 0.056;
  std::optional<double> wave_speed;
  double density = 1.06;
  void declare(Fields& f);
};

struct TargetOutletCase {
  std::optional<double> share, area;
  void declare(Fields& f);
};

/// What `tether fit-outlets` reads. In cgs units.
struct OutletsCase {
  std::string name;
  std::filesystem::path case_file;  ///< empty: no case is made
  std::optional<FlowCurveCase> flow;
  std::optional<double> mean_flow;
  double vessel_compliance = 0;
  TargetPressureCase pressure;
  SplitCase split;
  Named<TargetOutletCase> outlets;
  ProximalCase proximal;
  void declare(Fields& f);
  bool has_curve() const { return pressure.curve.has_value(); }
};

/// Throws InputError with a line for each mistake.
OutletsCase read_outlets_case(const std::filesystem::path& file);

/// The reference of the file: "text" or "markdown".
std::string outlets_reference(const std::string& format);

}  // namespace tether
