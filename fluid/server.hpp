#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "common/base/units.hpp"
#include "common/protocol/messages.hpp"
#include "fluid/fluid_series.hpp"

namespace tether::fluid {

/// What the fluid does with each message (common/protocol). A message without a line here does not compile.
class FluidServer {
 public:
  FluidServer(std::unique_ptr<FluidSolver> solver, const UnitSystem& units, std::string effective_case,
              std::filesystem::path output, std::vector<std::string> notices = {});

  protocol::Hello hello() const;

  protocol::Interface operator()(const protocol::GetInterface&);
  protocol::Ready operator()(const protocol::SetParameters& m);
  protocol::State operator()(const protocol::GetState&);
  protocol::Ready operator()(const protocol::SetState& m);
  protocol::Ready operator()(const protocol::BeginStep& m);
  protocol::StepReport operator()(const protocol::EndStep& m);
  protocol::Ready operator()(const protocol::Write& m);
  protocol::Ready operator()(const protocol::Stop&) { return {}; }
  protocol::Load operator()(const protocol::FluidEvaluate& m);
  protocol::Load operator()(const protocol::FluidTangent& m);
  protocol::Ready operator()(const protocol::MoveInterface& m);
  protocol::Velocity operator()(const protocol::GetVelocity& m);

 private:
  Points interface_points(const std::vector<double>& values, const char* what) const;

  std::unique_ptr<FluidSolver> solver_;
  UnitSystem units_;
  std::string effective_case_;
  std::vector<std::string> notices_;
  FluidSeries series_;
};

}  // namespace tether::fluid
