#include "solid/results/effects_list.hpp"

#include "common/io/record_json.ipp"

namespace tether {

TETHER_RECORD(EffectsList);

}  // namespace tether
