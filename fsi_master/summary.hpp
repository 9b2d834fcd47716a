#pragma once

#include <map>
#include <string>
#include <vector>

#include "fsi_master/results/run_summary.hpp"
#include "fsi_master/simulation.hpp"

namespace tether {

/// A process that took part.
struct RunProcess {
  std::string name, program;
  std::int64_t unknowns = 0;  ///< as it announces them; the master has none
};

/// What the summary tells beside the simulation itself.
struct RunFacts {
  std::string case_name, title, case_file, method;
  std::vector<RunProcess> processes;  ///< in the order of RunStatistics
  std::string effective_case;         ///< JSON
  double observer_gain = 0;           ///< the largest of any region [1/s]
  std::vector<std::string> notices;
  MadeFrom made_from;
  InterfaceRecord interface;
  std::optional<Periodicity> periodicity;
  std::optional<RestState> rest;
  std::map<std::string, std::string> written;  ///< files of results, and a hash of what each holds
};

/// What was run, how it went and what it cost, in the case's units and in mmHg and mm.
RunSummary summary_of(const Simulation& simulation, const RunFacts& facts);

/// The objects of several JSON texts as one; a text that is no object is left out.
std::string merged_json(const std::vector<std::string>& texts);

}  // namespace tether
