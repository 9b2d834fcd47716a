#pragma once

#include "common/config/curve_case.hpp"
#include "common/config/fields.hpp"

/// The section `observations` of a case: what was measured, and what is known of its errors.
namespace tether {

struct NoiseCase {
  Dimension dimension = dimension::length;  ///< of the values; set by the owner
  double deviation = 0, correlation_length = 0, correlation_time = 0;
  void declare(Fields& f);
};

/// What is known to be wrong with data, and is taken off them before they are used.
struct CorrectionCase {
  std::vector<double> displacement, rotation, about;  ///< empty: zero; else three numbers [length], [rad], [length]
  double outward = 0;                                 ///< [length]
  void declare(Fields& f);
  /// What is done to the data, for people: a line each.
  std::vector<std::string> notes(const std::string& unit) const;
  /// Points of the data where they should be.
  Points corrected(Points points) const;
};

/// What sources of lumen data have in common: where on the wall and when they count, and their errors.
struct LumenDataCase {
  double time_shift = 0, inlet_band = 0, outlet_band = 0;
  std::optional<double> trust_distance;
  std::vector<std::string> masked_regions;
  std::vector<double> held_out, left_out;
  CorrectionCase correction;
  NoiseCase noise;
  void declare(Fields& f);
};

/// Segmented surfaces over time.
struct SurfacesCase {
  std::filesystem::path file, folder;
  std::string pattern, unit;
  std::optional<double> first_time, interval, period;
  LumenDataCase data;
  void declare(Fields& f);
};

/// Contours in slices over time.
struct SlicesCase {
  std::filesystem::path file;
  std::string unit = "heading";
  std::vector<std::string> slices;
  std::optional<double> beat, period;
  int samples = 64;
  LumenDataCase data;
  void declare(Fields& f);
};

/// The field `quantity`, and the dimension that follows from it.
void declare_quantity(Fields& f, std::string& quantity, Dimension& dimension);

/// A measured pressure or flow.
struct TraceCase {
  std::string observable, quantity;
  CurveCase curve = CurveCase(Dimension{});
  double time_shift = 0;
  bool absolute = true, held_out = false;
  NoiseCase noise;
  void declare(Fields& f);
};

/// Velocities at points of space, as phase-contrast MR measures them on planes.
struct VelocitiesCase {
  std::filesystem::path file;
  std::string components = "vector";
  Vec3 direction = Vec3::Constant(undefined);
  std::optional<double> beat, period;
  double time_shift = 0;
  std::vector<double> held_out;
  NoiseCase noise{dimension::velocity};
  void declare(Fields& f);
};

struct ObservationsCase {
  Named<SurfacesCase> surfaces;
  Named<SlicesCase> contours;
  Named<TraceCase> traces;
  Named<VelocitiesCase> velocities;
  void declare(Fields& f);
  bool has_lumen_data() const { return !surfaces.empty() || !contours.empty(); }
};

}  // namespace tether
