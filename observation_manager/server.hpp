#pragma once

#include "common/observation/observations.hpp"
#include "common/protocol/messages.hpp"

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

/// The same for the measurements of the blood.
class FlowObservationServer {
 public:
  FlowObservationServer(FlowObservations observations, const UnitSystem& units, std::string effective_case)
      : observations_(std::move(observations)), units_(units), effective_case_(std::move(effective_case)) {}

  /// Its observables are the sources, in the order of their numbers.
  protocol::Hello hello() const;
  /// The points where the velocity is wanted, without triangles.
  protocol::Interface operator()(const protocol::GetInterface&) const;
  protocol::Ready operator()(const protocol::SetParameters& m);
  protocol::Ready operator()(const protocol::Write&) { return {}; }
  protocol::Ready operator()(const protocol::Stop&) { return {}; }
  protocol::FlowDiscrepancy operator()(const protocol::ObserveFlow& m) const;

 private:
  FlowObservations observations_;
  UnitSystem units_;
  std::string effective_case_;
};

/// Samples as the protocol has them.
protocol::Discrepancy as_message(const std::vector<Sample>& samples);
protocol::FlowDiscrepancy as_message(const std::vector<FlowSample>& samples);

}  // namespace tether
