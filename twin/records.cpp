#include "common/io/record_json.ipp"
#include "twin/score.hpp"

namespace tether {

TETHER_RECORD(Answer);
TETHER_RECORD(Claim);
TETHER_RECORD(Score);

}  // namespace tether
