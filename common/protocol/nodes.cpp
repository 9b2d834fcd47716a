#include "common/protocol/nodes.hpp"

#include <cstdlib>
#include <sstream>

namespace tether::protocol {

std::vector<std::string> nodes_of_job() {
  const char* text = std::getenv(nodes_variable);
  std::istringstream list(text == nullptr ? "" : text);
  std::vector<std::string> nodes;
  for (std::string node; std::getline(list, node, ',');)
    if (!node.empty()) nodes.push_back(node);
  if (nodes.size() == 1) nodes.clear();
  return nodes;
}

std::string own_node() {
  const std::vector<std::string> nodes = nodes_of_job();
  if (nodes.empty()) return {};
  const char* own = std::getenv(node_variable);
  return own == nullptr ? nodes.front() : own;
}

}  // namespace tether::protocol
