#pragma once

#include <functional>

#include "common/protocol/launch.hpp"
#include "identification_master/ensemble.hpp"

namespace tether {

/// Groups of processes (an fsi_master with its codes each) that share the work: each piece goes to the first that is
/// free.
class GroupPool : public Ensemble {
 public:
  /// All groups have said hello. Throws InputError if their codes announce no states.
  GroupPool(protocol::Session& session, std::vector<protocol::Partner*> groups);

  const protocol::Hello& model() const override { return groups_.front()->hello(); }
  VectorXd initial_state() override;
  std::vector<ParticleReport> advance(const EnsembleStep& step, const std::vector<NamedValues>& values,
                                      MatrixXd& states, std::vector<std::vector<double>>& memories) override;

  std::size_t size() const { return groups_.size(); }
  /// Positions of the lumen's nodes in the image.
  Points lumen();
  /// Sums over all processes of all groups.
  protocol::Usage usage();

 private:
  /// Sends request(i) for all i < count, each to a group that is free, and hands the replies to `take`.
  template <class Request>
  void deal(std::size_t count, const std::function<Request(std::size_t)>& request,
            const std::function<void(std::size_t, typename Request::Reply)>& take);

  Points lumen_in(const std::vector<double>& state) const;

  protocol::Session& session_;
  std::vector<protocol::Partner*> groups_;
  Points imaged_ = Points(3, 0);  ///< the lumen's nodes, once they were asked for
};

}  // namespace tether
