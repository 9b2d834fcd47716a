#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "common/config/case_file.hpp"
#include "common/protocol/launch.hpp"
#include "fsi_master/coupling_case.hpp"
#include "fsi_master/message_partners.hpp"
#include "fsi_master/results/run_summary.hpp"
#include "fsi_master/simulation.hpp"
#include "fsi_master/transfer/interface_fit.hpp"
#include "observation_manager/measurements/flow_observations.hpp"

namespace tether {

/// A case file and the sections of it that the master reads.
struct MasterCase {
  explicit MasterCase(const std::filesystem::path& path) : file(path) {
    file.read("coupling", coupling);
    file.read("initial_state", initial_state);
    ObservationsCase observations;
    file.read("observations", observations);
    file.finish();
    flow = load_flow_observations(observations, file);
    measures_lumen = observations.has_distances();
  }
  CaseFile file;
  CouplingCase coupling;
  std::optional<InitialStateCase> initial_state;
  FlowObservations flow;  ///< to record the velocity where it was measured
  bool measures_lumen = false;
};

/// The partners of one coupled vessel as processes: fluid, solid, and measurements if there are any.
class CoupledCodes {
 public:
  /// processes: fluid, solid, and the measurements of the wall or none; all have said hello. Throws InputError if they
  /// do not fit together, or the case asks for a state observer that they do not have.
  CoupledCodes(const MasterCase& master, std::span<protocol::Partner> processes);

  MessageFluid& fluid() { return *fluid_; }
  MessageSolid& solid() { return *solid_; }
  Coupling& coupling() { return *coupling_; }
  Crew crew();
  std::span<protocol::Partner> processes() const { return processes_; }
  const InterfaceSurface& interface() const { return interface_; }
  const ToldLumen& lumen() const { return lumen_; }
  /// How the fluid's interface lies on it, and what got lost between them so far.
  InterfaceRecord interface_record() const;
  /// What a person should know of interfaces that do not match; none if they do.
  std::vector<std::string> interface_notices() const;
  /// Of its interface [length].
  double size() const { return size_; }
  /// The process that measures; none if the case has no data.
  protocol::Partner* measurements() const { return processes_.size() > 2 ? &processes_[2] : nullptr; }

 private:
  std::span<protocol::Partner> processes_;
  InterfaceSurface interface_;  ///< of the solid
  double size_;
  UnitSystem units_;
  InterfaceFit fit_;
  std::string mapping_;  ///< that is used
  std::optional<MessageFluid> fluid_;
  ToldLumen lumen_;
  std::optional<MessageSolid> solid_;
  std::unique_ptr<Coupling> coupling_;
  std::optional<MessageObservation> observation_;
  std::unique_ptr<Observer> observer_;
};

/// The processes that a case asks for; with that of the measurements or without.
std::vector<protocol::Program> programs_of(const MasterCase& master, bool with_measurements);

}  // namespace tether
