#include "identification_master/results/estimate.hpp"

#include "common/io/record_json.ipp"

namespace tether {

TETHER_RECORD(Estimate);

}  // namespace tether
