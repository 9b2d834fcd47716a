#pragma once

#include "common/protocol/messages.hpp"
#include "observation_manager/measurements/observations.hpp"

namespace tether {

/// Answers the messages of a master with the measurements of a case.
class ObservationServer {
 public:
  /// nodes: of the lumen that the master will ask about.
  ObservationServer(Observations observations, Eigen::Index nodes, std::string effective_case)
      : observations_(std::move(observations)), nodes_(nodes), effective_case_(std::move(effective_case)) {}

  protocol::Hello hello() const;
  protocol::Ready operator()(const protocol::SetParameters& m);
  protocol::Ready operator()(const protocol::Write&) { return {}; }
  protocol::Ready operator()(const protocol::Stop&) { return {}; }
  protocol::Discrepancy operator()(const protocol::Observe& m);

 private:
  Observations observations_;
  Eigen::Index nodes_;
  std::string effective_case_;
};

/// Samples as the protocol has them.
protocol::Discrepancy as_message(const std::vector<Sample>& samples);

}  // namespace tether
