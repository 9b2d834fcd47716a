#include "common/base/checked_file.hpp"
#include "common/config/input_files.hpp"
#include "fsi_master/checkpoint.hpp"

namespace tether {

std::uint64_t fingerprint(const std::vector<std::string>& effective_cases, double dt, const Points& interface) {
  std::uint64_t hash = hash_bytes(&dt, sizeof dt);
  hash = hash_bytes(interface.data(), sizeof(double) * static_cast<std::size_t>(interface.size()), hash);
  for (const std::string& effective_case : effective_cases) hash = hash_case(effective_case, hash);
  return hash;
}

}  // namespace tether
