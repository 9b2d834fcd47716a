#pragma once

#include <deque>
#include <optional>
#include <set>
#include <vector>

#include "identification_master/run_makers.hpp"
#include "identification_master/run_store.hpp"

namespace tether {

/// Runs of one model for whoever asks for them (protocol::ToRunService): dealt to groups that live on from one to the
/// next, and not made again where a folder holds the same run already, or those that are shared have it.
class RunService {
 public:
  /// case_hash: of all that the runs depend on beside their values.
  RunService(RunMakers& makers, std::string case_hash, std::int64_t steps, RunStore shared = {});

  const protocol::Hello& hello() const { return makers_.model(); }
  protocol::Ready operator()(const protocol::OrderRuns& m);
  /// Throws RunError if none is under way, or a group cannot go on.
  protocol::RunEnded operator()(const protocol::NextRun&);
  protocol::Ready operator()(const protocol::Stop&) { return {}; }

 private:
  struct Work {
    protocol::RunOrder order;
    std::string guide;
    MadeRun run;  ///< what it will be of
  };

  /// A run that was made before. One that failed is made again by another service: what it lacked may be there now.
  std::optional<MadeRun> stored(const MadeRun& wanted, const std::string& folder) const;
  MadeRun run_of(const protocol::RunOrder& order) const;
  /// All numbers of the model: a group keeps what it was last told. Throws RunError for one that it does not have.
  protocol::Simulate request(const protocol::RunOrder& order) const;
  void begin_waiting();
  void end_next();

  RunMakers& makers_;
  std::string case_hash_;
  std::int64_t steps_;
  RunStore shared_;
  std::deque<Work> waiting_;
  std::vector<std::optional<Work>> at_work_;  ///< of each group
  std::deque<protocol::RunEnded> ended_;
  std::set<std::string> failed_;  ///< folders of runs that this service made
};

}  // namespace tether
