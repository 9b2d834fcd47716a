#include "common/catalogue/effects_list.hpp"

#include <cmath>

#include "common/io/record_json.ipp"

namespace tether {

TETHER_RECORD(EffectsList);

PossibleEffect possible_effect(const EffectDeclaration& effect, const UnitSystem& units) {
  PossibleEffect possible{.type = effect.name,
                          .part = {},
                          .meaning = effect.meaning,
                          .role = effect.role,
                          .generic = effect.generic,
                          .variant_of = effect.variant_of,
                          .amplitudes = {},
                          .required = {},
                          .path = {}};
  for (const Parameter& p : effect.parameters) {
    const bool switches = !std::isnan(p.absent), must_be_given = std::isnan(p.standard);
    if (switches) possible.amplitudes.push_back({p.name, p.meaning, units.symbol(p.dimension)});
    if (must_be_given) possible.required.push_back(p.name);
  }
  return possible;
}

}  // namespace tether
