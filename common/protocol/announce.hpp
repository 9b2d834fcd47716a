#pragma once

#include "common/base/parameter_table.hpp"
#include "common/protocol/messages.hpp"

namespace tether::protocol {

/// What a partner's Hello says of a parameter, in the case's units.
inline ParameterInfo info_of(const ParameterTable::Entry& entry, const UnitSystem& units) {
  const Parameter& p = entry.declaration;
  const bool linear = p.transform == Transform::linear;
  const double scale = linear && p.scale != p.scale ? p.prior_deviation : p.scale;
  return {entry.name,
          p.meaning,
          units.symbol(p.dimension),
          name_of(p.transform),
          entry.value(),
          p.absent,
          p.range.lower,
          p.range.upper,
          linear ? units.from_si(p.prior_deviation, p.dimension) : p.prior_deviation,
          units.from_si(scale, p.dimension)};
}

}  // namespace tether::protocol
