#pragma once

#include <utility>

#include "common/protocol/partner.hpp"
#include "fsi_master/partners.hpp"
#include "fsi_master/transfer/announced_interface.hpp"
#include "fsi_master/transfer/interface_map.hpp"

namespace tether {

/// Samples to nodes (O.5): weight H' w, direction H' (w d n) along the mean normal H' (w n).
Innovation at_nodes(const protocol::Discrepancy& samples, Eigen::Index nodes);

/// A fluid in another process. Its vectors are mapped from and to the solid's interface nodes.
class MessageFluid : public FluidPartner {
 public:
  MessageFluid(protocol::Partner& partner, InterfaceMap map) : partner_(partner), map_(std::move(map)) {}
  const InterfaceMap& map() const { return map_; }
  std::string name() const override;
  bool has_tangent() const override;
  bool has_state() const override;

  Later<Done> begin_step(const StepStart& start) override;
  Later<std::vector<double>> end_step(bool accepted) override;
  Later<std::vector<double>> state() override;
  Later<Done> set_state(std::vector<double> values) override;
  Later<Done> write(std::int64_t step, double time) override;
  Later<PartnerUsage> usage() override;

  Later<VectorXd> load(const Motion& motion) override;
  Later<VectorXd> load_change(const VectorXd& velocity_change) override;
  bool has_observer() const override;
  Later<Done> move_interface(const VectorXd& change) override;
  bool has_velocity() const override;
  Later<Points> velocity_at(const Points& points) override;
  /// The worst of what got lost between the interfaces in evaluations so far; zero where nodes match.
  const InterfaceBalance& balance() const { return balance_; }

 private:
  VectorXd received(const protocol::Load& load) const;

  protocol::Partner& partner_;
  InterfaceMap map_;
  InterfaceBalance balance_;
};

/// A solid in another process; its interface nodes are the master's.
class MessageSolid : public SolidPartner {
 public:
  /// interface_size: the diagonal of the box around it; displacements that are much larger fail the step [length].
  explicit MessageSolid(protocol::Partner& partner, double interface_size = infinite)
      : partner_(partner), interface_size_(interface_size) {}
  std::string name() const override;
  bool has_tangent() const override;
  bool has_operators() const override;
  bool has_state() const override;

  Later<Done> begin_step(const StepStart& start) override;
  Later<std::vector<double>> end_step(bool accepted) override;
  Later<std::vector<double>> state() override;
  Later<Done> set_state(std::vector<double> values) override;
  Later<Done> write(std::int64_t step, double time) override;
  Later<PartnerUsage> usage() override;

  Later<Motion> motion(const VectorXd& load) override;
  Later<VectorXd> velocity_change(const VectorXd& load_change) override;
  Later<Iterate> residual(const VectorXd& correction, const VectorXd& load) override;
  Later<VectorXd> product(const VectorXd& direction) override;
  Later<VectorXd> precondition(const VectorXd& residual) override;
  bool has_observer() const override;
  Later<VectorXd> correct(double dt, const Innovation& data) override;
  Later<Done> withdraw(double share) override;
  Later<VectorXd> set_drift(const Innovation& data) override;

 private:
  /// Throws StepFailure if it is not finite, or no wall's.
  VectorXd displacement_of(const std::vector<double>& values, Eigen::Index size) const;

  protocol::Partner& partner_;
  double interface_size_;
};

/// An observation_manager in another process; its samples are gathered at the interface's nodes (O.5).
class MessageObservation : public ObservationPartner {
 public:
  explicit MessageObservation(protocol::Partner& partner) : partner_(partner) {}
  Later<Innovation> observe(double time, const VectorXd& points) override;

 private:
  protocol::Partner& partner_;
};

}  // namespace tether
