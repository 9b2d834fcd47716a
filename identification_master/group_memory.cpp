#include "identification_master/group_memory.hpp"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace tether {

double memory_of_group(std::size_t nodes) {
  constexpr double fixed = 80e6, of_node = 20e3;
  return fixed + of_node * static_cast<double>(nodes);
}

std::size_t groups_within(double memory, std::size_t nodes) {
  constexpr double share = 0.8, many = 1e6;
  return static_cast<std::size_t>(std::clamp(share * memory / memory_of_group(nodes), 1.0, many));
}

double available_memory() {
  std::ifstream file("/proc/meminfo");
  std::string name, unit;
  for (double kilobytes = 0; file >> name >> kilobytes; std::getline(file, unit))
    if (name == "MemAvailable:") return 1024 * kilobytes;
  return std::numeric_limits<double>::infinity();
}

}  // namespace tether
