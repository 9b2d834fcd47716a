#pragma once

#include <filesystem>
#include <memory>

#include "common/base/units.hpp"
#include "common/protocol/messages.hpp"
#include "solid/case.hpp"
#include "solid/solid_solver.hpp"
#include "solid/state_observer.hpp"

namespace tether {

class WallSeries;

/// What the solid does with each message (common/protocol). A message without a line here does not compile.
class SolidServer {
 public:
  SolidServer(PreparedWall wall, const UnitSystem& units, std::string effective_case, std::filesystem::path output);
  SolidServer(SolidServer&&) noexcept;
  ~SolidServer();

  protocol::Hello hello() const;

  protocol::Interface operator()(const protocol::GetInterface&);
  protocol::Ready operator()(const protocol::SetParameters& m);
  protocol::State operator()(const protocol::GetState&);
  protocol::Ready operator()(const protocol::SetState& m);
  protocol::Ready operator()(const protocol::BeginStep& m);
  protocol::StepReport operator()(const protocol::EndStep& m);
  protocol::Ready operator()(const protocol::Write& m);
  protocol::Ready operator()(const protocol::Stop&);
  protocol::Motion operator()(const protocol::SolidEvaluate& m);
  protocol::Motion operator()(const protocol::SolidTangent& m);
  protocol::SolidResidualReply operator()(const protocol::SolidResidual& m);
  protocol::Unknowns operator()(const protocol::SolidProduct& m);
  protocol::Unknowns operator()(const protocol::SolidPrecondition& m);
  protocol::Correction operator()(const protocol::Correct& m);
  protocol::Ready operator()(const protocol::Withdraw& m);

 private:
  NodalDistances distances_of(const protocol::Correct& m) const;
  Points interface_points(const std::vector<double>& values, const char* what) const;

  std::unique_ptr<WallModel> model_;
  std::unique_ptr<SolidSolver> solver_;
  std::unique_ptr<StateObserver> observer_;  ///< none if the case has no gain
  double dt_ = 0;                            ///< of the step begun last [time]
  Points corrected_;                         ///< by the last correction, as far as it was not taken back
  UnitSystem units_;
  std::string effective_case_;
  std::vector<std::string> notices_;
  RestState rest_;
  bool rest_is_written_ = false;
  std::filesystem::path output_;
  std::unique_ptr<WallSeries> series_;
};

}  // namespace tether
