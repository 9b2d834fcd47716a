#pragma once

#include <filesystem>
#include <memory>

#include "common/base/child_process.hpp"
#include "common/config/command_line.hpp"
#include "common/protocol/partner.hpp"
#include "common/protocol/socket_channel.hpp"
#include "diagnosis/evidence/model_runs.hpp"

namespace tether {

/// Runs that an identification_master makes, which lives as long as this object: its groups of processes, their meshes
/// and factors are there from one run to the next. The first run, asked for alone, guides the others. The service ends
/// when this process does, and the other way round.
class LivingRuns : public ModelRuns {
 public:
  /// Starts it on a case. output: below it are the folders of the runs, and what the programs write. command: how many
  /// processes share the work, how many steps are made, which folder of runs is shared, whether to be quiet. Throws
  /// InputError if the case is refused.
  LivingRuns(const CommandLine& command, const std::filesystem::path& case_file, std::filesystem::path output);
  ~LivingRuns() override;

  const std::vector<protocol::ParameterInfo>& parameters() const override { return model_.parameters; }
  std::vector<std::string> columns() const override;
  std::vector<FinishedMotion> make(const std::vector<WantedRun>& wanted) override;
  RunsCost cost() const override { return cost_; }

 private:
  /// What it answers. Throws how it ended if it did.
  template <class Request>
  typename Request::Reply ask(const Request& request);
  protocol::OrderRuns order_of(const std::vector<WantedRun>& wanted);
  void note(const protocol::RunEnded& ended);
  [[noreturn]] void fail();

  std::filesystem::path output_;
  bool quiet_;
  CommandLine command_;  ///< of the service
  protocol::SocketListener listener_;
  RunningProgram service_;
  std::unique_ptr<protocol::Partner> partner_;
  protocol::Hello model_;
  std::string guide_;  ///< folder of the first run: the others begin their steps as it did
  RunsCost cost_;
};

}  // namespace tether
