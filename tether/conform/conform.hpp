#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/base/units.hpp"
#include "common/protocol/partner.hpp"

/// The conformance check: plays the master against any fluid or solid and tries out the contract of docs/protocol.md.
namespace tether::protocol {

struct Check {
  enum class Result { passed, failed, skipped };
  std::string name;
  Result result;
  std::string detail;  ///< what was found wrong, or measured; why it was skipped
};

/// A code that the partner is to be coupled with, and the units of both.
struct Counterpart {
  Partner& partner;
  UnitSystem units;
};

/// Runs all checks with time steps `dt` and stops the partner. After a death the remaining checks are missing, the last
/// one says it. With a counterpart, also whether the interfaces of both fit.
std::vector<Check> conform(Partner& partner, double dt, const std::optional<Counterpart>& counterpart = {});

/// A table for people, and whether nothing failed.
std::string table_of(const std::vector<Check>& checks);
bool all_passed(const std::vector<Check>& checks);

}  // namespace tether::protocol
