#pragma once

#include <string>

#include "vessel/model/vessel_model.hpp"

namespace tether {

/// A case that runs a model, to begin from: at the inlet a beat of 0.9 s with a mean velocity of 11 cm/s (5 l/min in an
/// adult's aorta); Windkessels for a mean pressure of 93 mmHg, their flow shared as the cubes of their radii (Murray
/// 1926), with 1.5 s of discharge; an elastic wall, softly held. What of it is of a patient, its user has to state.
/// mesh_section: of the case file.
std::string ready_case(const std::string& name, const VesselModel& model, const std::string& mesh_section,
                       const UnitSystem& units);

/// The flow of that beat at the inlet, in ml/s: columns time and flow.
std::string ready_flow(const VesselModel& model, const UnitSystem& units);

}  // namespace tether
