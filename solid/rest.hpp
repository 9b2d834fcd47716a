#pragma once

#include "common/config/case.hpp"
#include "solid/results/rest_state.hpp"
#include "solid/wall_model.hpp"

namespace tether {

/// What the surroundings must do so that the image rests under its pressure. Their forces are on the outer wall (S.14):
/// each node's over its share of the area.
HeldBySurroundings held_by_surroundings(const WallMesh& mesh, const InitialStress& initial, double pressure);

/// The wall as it begins, in the image. initial: none if it was given none.
RestState rest_of(const WallModel& model, const ImageCase& image, const InitialStress* initial);

/// For a person.
std::string describe(const HeldBySurroundings& held);

}  // namespace tether
