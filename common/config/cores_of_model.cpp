#include "common/config/cores_of_model.hpp"

#include <algorithm>
#include <cstdlib>

namespace tether {

int cores_of_model(const CaseFile& file) {
  const auto ranks = [&file](const char* code) {
    return std::atoi(file.given(std::string("coupling.ranks.") + code).c_str());
  };
  return std::max({1, ranks("fluid"), ranks("solid")});
}

}  // namespace tether
