#include "solid/results/rest_state.hpp"

#include "common/io/record_json.ipp"

namespace tether {

TETHER_RECORD(RestState);

}  // namespace tether
