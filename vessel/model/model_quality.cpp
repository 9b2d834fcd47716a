#include "vessel/model/model_quality.hpp"

#include "common/io/record_json.ipp"

namespace tether {

TETHER_RECORD(ModelQuality);

}  // namespace tether
