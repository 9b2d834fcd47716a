#pragma once

#include <functional>

#include "common/protocol/launch.hpp"
#include "identification_master/ensemble.hpp"

namespace tether {

/// Groups of processes (an fsi_master with its codes each) that share the particles: of G groups the g-th has the
/// particles g, g + G, ... in each step, so that a run can be repeated to the bit.
class GroupPool : public Ensemble {
 public:
  /// All groups have said hello. Throws InputError if their codes announce no states.
  GroupPool(protocol::Session& session, std::vector<protocol::Partner*> groups);

  const protocol::Hello& model() const override { return groups_.front()->hello(); }
  VectorXd initial_state() override;
  std::vector<ParticleReport> advance(const EnsembleStep& step, const std::vector<NamedValues>& values,
                                      MatrixXd& states, std::vector<std::vector<double>>& memories) override;

  std::size_t size() const { return groups_.size(); }
  /// The state of each group, which beside that of its last particle holds what its codes have made in steps before
  /// (factors): for a checkpoint. With `take_up` as many groups go on to the same bits; others, or none, to those that
  /// the coupling's tolerance leaves open.
  std::vector<std::vector<double>> at_hand();
  void take_up(const std::vector<std::vector<double>>& states);
  /// Positions of the lumen's nodes in the image.
  Points lumen();
  /// Sums over all processes of all groups.
  protocol::Usage usage();

 private:
  /// Sends request(i) for all particles i < count, and hands the replies to `take`.
  void deal(std::size_t count, const std::function<protocol::Advance(std::size_t)>& request,
            const std::function<void(std::size_t, protocol::Advanced)>& take);

  Points lumen_in(const std::vector<double>& state) const;

  protocol::Session& session_;
  std::vector<protocol::Partner*> groups_;
  Points imaged_ = Points(3, 0);  ///< the lumen's nodes, once they were asked for
};

}  // namespace tether
