#include "common/protocol/roster.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "common/base/error.hpp"

namespace tether::protocol {

namespace {

/// 0: identification_master, 1: a master of solvers, 2: a solver, -1: nobody.
int level_of(const std::string& role) {
  constexpr std::array solvers{"fluid", "solid", "solid_observation"};
  if (role.empty()) return -1;
  if (role == "identification_master") return 0;
  return std::find(solvers.begin(), solvers.end(), role) == solvers.end() ? 1 : 2;
}

}  // namespace

int master_of(const std::vector<std::string>& roles, int rank) {
  const std::string& role = roles[static_cast<std::size_t>(rank)];
  const int level = level_of(role);
  std::vector<int> masters, alike;
  for (int other = 0; other < static_cast<int>(roles.size()); ++other) {
    const std::string& theirs = roles[static_cast<std::size_t>(other)];
    if (level >= 0 && level_of(theirs) >= 0 && level_of(theirs) == level - 1) masters.push_back(other);
    if (theirs == role) alike.push_back(other);
  }
  if (masters.empty()) return -1;
  if (alike.size() % masters.size() != 0)
    throw input_error("the mpirun line has {} {} for {} {}: each needs as many", alike.size(), role, masters.size(),
                      roles[static_cast<std::size_t>(masters[0])]);
  const auto place = std::find(alike.begin(), alike.end(), rank) - alike.begin();
  return masters[static_cast<std::size_t>(place) / (alike.size() / masters.size())];
}

void check_one_leads(const std::vector<std::string>& roles) {
  for (const int level : {0, 1}) {
    std::vector<std::string> leaders;
    std::copy_if(roles.begin(), roles.end(), std::back_inserter(leaders),
                 [level](const std::string& role) { return level_of(role) == level; });
    if (leaders.empty()) continue;
    const std::size_t count = leaders.size();
    if (count == 1) return;
    std::sort(leaders.begin(), leaders.end());
    leaders.erase(std::unique(leaders.begin(), leaders.end()), leaders.end());
    throw input_error(
        "the mpirun line has {} masters that none leads ({}), each of which would make a run: give it one", count,
        fmt::join(leaders, ", "));
  }
}

std::vector<int> partners_of(const std::vector<std::string>& roles, int rank) {
  std::vector<int> partners;
  for (int other = 0; other < static_cast<int>(roles.size()); ++other)
    if (master_of(roles, other) == rank) partners.push_back(other);
  return partners;
}

}  // namespace tether::protocol
