#pragma once

#include "fsi_master/partners.hpp"

namespace tether {

/// What the state observer did to a run.
struct ObserverStatistics {
  std::int64_t corrections = 0, weakened = 0;  ///< weakened: halved until the blood's mesh could follow
  double largest = 0;                          ///< correction of a step, of an interface node [length]
};

/// The displacement observer over a coupled run: asks the measurements where the lumen should be, and moves wall and
/// mesh toward it, between the steps (O.8) or within them (O.9). The blood's flow takes no notice: what moves is the
/// estimate.
class Observer {
 public:
  enum class Form { split, monolithic };

  /// rest: reference positions of the interface, x0 y0 z0 x1 ...
  Observer(ObservationPartner& data, FluidPartner& fluid, SolidPartner& solid, Form form, VectorXd rest);

  Form form() const { return form_; }
  /// After an accepted step of length dt that ended at `time` with the interface displaced by y. Returns how far the
  /// interface was moved; a correction that the blood's mesh cannot follow is halved, at last given up.
  VectorXd correct(double time, double dt, const VectorXd& y);
  /// Sets the drift during the step of length dt begun from the distances of an interface displaced by y, and moves the
  /// blood's mesh by what comes of it, that of the wall follows in the step. Returns its interface part. A drift that
  /// the mesh cannot follow is halved, at last none.
  VectorXd begin_drift(double time, double dt, const VectorXd& y);
  /// The drift anew, weakened as when the step began; the mesh stays.
  VectorXd drift(double time, const VectorXd& y);
  void move_mesh(const VectorXd& change) { fluid_.move_interface(change).get(); }
  /// A step has been corrected by this much.
  void count(const VectorXd& change);

  const ObserverStatistics& statistics() const { return statistics_; }

 private:
  ObservationPartner& data_;
  FluidPartner& fluid_;
  SolidPartner& solid_;
  Form form_;
  VectorXd rest_;
  double share_ = 1;  ///< of the drift that the mesh can follow in this step
  ObserverStatistics statistics_;
};

}  // namespace tether
