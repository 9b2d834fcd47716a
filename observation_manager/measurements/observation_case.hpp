#pragma once

#include <stdexcept>

#include "common/config/fields.hpp"
#include "observation_manager/measurements/faults/faults.hpp"
#include "observation_manager/measurements/registry.hpp"

/// The section `observations` of a case: what was measured, and what is known of its errors.
namespace tether {

inline constexpr Word millimetre{"mm", "millimetre"}, centimetre{"cm", "centimetre"}, metre{"m", "metre"};

struct NoiseCase {
  Dimension dimension = dimension::length;  ///< of the values; set by the owner
  double deviation = 0, correlation_length = 0, correlation_time = 0;
  void declare(Fields& f);
};

/// What is known to be wrong with data, and is taken off them before they are used.
struct CorrectionCase {
  explicit CorrectionCase(const Fallible& data) : faults(data) {}
  Faults faults;
  Dimension dimension = dimension::length;  ///< of the values; set by the owner
  void declare(Fields& f) { faults.declare_corrections(f, dimension); }
};

/// What sources of lumen data have in common: where on the wall and when they count, and their errors.
struct LumenDataCase {
  double time_shift = 0, inlet_band = 0, outlet_band = 0;
  std::optional<double> trust_distance;
  std::vector<std::string> masked_regions;
  std::vector<double> held_out, left_out;
  CorrectionCase correction{fallible::image};
  NoiseCase noise;
  void declare(Fields& f);
  StatedErrors stated_errors() const { return {&correction, time_shift, left_out}; }
};

/// A part of the wall for which distances are told: some of its regions together.
struct ErrorRegionCase {
  std::vector<std::string> of;
  void declare(Fields& f);
};

/// What was measured: for each kind its sources.
class ObservationsCase {
 public:
  Named<ErrorRegionCase> regions;  ///< none: those of the wall

  ObservationsCase();
  ObservationsCase(const ObservationsCase& other);
  ObservationsCase(ObservationsCase&&) = default;
  ObservationsCase& operator=(ObservationsCase) = delete;
  void declare(Fields& f);
  /// Whether there is anything that may pull the wall.
  bool has_distances() const;
  /// Of a source by its place in the case: "observations.surfaces.ct". Throws std::logic_error if there is none.
  StatedErrors errors_of(const std::string& field) const;
  const std::vector<std::unique_ptr<KindSection>>& sections() const { return sections_; }

  /// The sources of the kind whose section reads a `Case`: of<SurfacesCase>().
  template <class Case>
  Named<Case>& of() {
    for (const auto& section : sections_)
      if (auto* found = dynamic_cast<SectionOf<Case>*>(section.get())) return found->sources;
    throw std::logic_error("a case of no registered kind of measurement");
  }
  template <class Case>
  const Named<Case>& of() const {
    return const_cast<ObservationsCase*>(this)->of<Case>();
  }

 private:
  std::vector<std::unique_ptr<KindSection>> sections_;
};

}  // namespace tether
