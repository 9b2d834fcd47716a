#pragma once

#include "common/catalogue/effects_list.hpp"
#include "common/config/case_file.hpp"
#include "solid/case.hpp"

namespace tether {

/// What `solid --list-effects CASE.yaml` answers: every effect of the catalogue on every part of the wall that
/// the case does not have there yet, and the supports and effects that it has (docs/diagnosis.md). Motions are left
/// out: they move what something else holds.
EffectsList list_effects(const SolidCase& solid, const WallMesh& mesh, const UnitSystem& units);

}  // namespace tether
