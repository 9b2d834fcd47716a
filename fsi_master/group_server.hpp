#pragma once

#include <array>
#include <memory>
#include <string>

#include "common/protocol/messages.hpp"
#include "fsi_master/coupled_codes.hpp"
#include "fsi_master/time_loop.hpp"

namespace tether {

/// An fsi_master as a partner: one group of processes that computes steps of particles, or whole runs, for an
/// identification_master. A particle's state is [fluid | solid | y | V], its parts as the codes and the time loop have
/// them.
class GroupServer {
 public:
  /// `plan`: of the whole runs that may be asked for; their output is said later.
  GroupServer(std::unique_ptr<MasterCase> master, RunPlan plan, std::span<protocol::Partner> processes);

  protocol::Hello hello() const;
  protocol::Interface operator()(const protocol::GetInterface&);
  protocol::Ready operator()(const protocol::SetParameters& m);
  protocol::State operator()(const protocol::GetState&);
  protocol::Ready operator()(const protocol::SetState& m);
  protocol::Advanced operator()(const protocol::Advance& m);
  protocol::Simulated operator()(const protocol::Simulate& m);
  protocol::Ready operator()(const protocol::Write& m);
  protocol::Ready operator()(const protocol::Stop&) { return {}; }
  /// Of all processes of the group; memory is the sum of their peaks.
  protocol::Usage operator()(const protocol::GetUsage&);

 private:
  /// Each process' share of the parameters, under its own names. Throws InputError for a name that neither has.
  std::array<protocol::SetParameters, 2> divided(const protocol::SetParameters& all) const;
  void observe(double time, protocol::Advanced& reply);
  void restore(const std::vector<double>& state, const std::vector<double>& memory);
  std::vector<double> packed(const Snapshot& snapshot) const;

  std::unique_ptr<MasterCase> master_;
  std::unique_ptr<CoupledCodes> codes_;
  RunPlan plan_;
  std::unique_ptr<TimeLoop> loop_;
  Snapshot initial_;
  std::array<protocol::SetParameters, 2> present_;  ///< all parameters of fluid and solid as they are now
};

}  // namespace tether
