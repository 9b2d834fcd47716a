#include "fsi_master/coupled_codes.hpp"

#include "common/base/error.hpp"

namespace tether {
namespace {

InterfaceMap map_of(const CouplingCase& coupling, const InterfaceSurface& fluid, const InterfaceSurface& solid) {
  const double size = diagonal(solid.points);
  if (coupling.mapping == "match")
    return InterfaceMap::match(fluid, solid, coupling.mapping_distance.value_or(1e-5 * size));
  return InterfaceMap::nearest_triangle(fluid, solid, coupling.mapping_distance.value_or(0.02 * size));
}

/// `field`: of coupling.programs.
protocol::Program partner_program(const char* role, const char* field, const std::string& executable,
                                  const CaseFile& file) {
  const std::string where = file.where(std::string("coupling.programs.") + field);
  return {role, executable, {std::filesystem::absolute(file.path()).string()}, 1, where};
}

/// Throws InputError if a code has no state observer.
std::unique_ptr<Observer> make_observer(const ObserverCase& observer, ObservationPartner& data, FluidPartner& fluid,
                                        SolidPartner& solid, const Points& interface) {
  for (const auto& [name, has] : {std::pair{fluid.name(), fluid.has_observer()}, {solid.name(), solid.has_observer()}})
    if (!has) throw input_error("observer.gain: {} cannot be moved by a state observer", name);
  const auto form = observer.form == "split" ? Observer::Form::split : Observer::Form::monolithic;
  return std::make_unique<Observer>(data, fluid, solid, form, interface.reshaped());
}

}  // namespace

CoupledCodes::CoupledCodes(const MasterCase& master, std::span<protocol::Partner> processes)
    : processes_(processes), interface_(ask_interface(processes[1])), size_(diagonal(interface_.points)) {
  const InterfaceSurface of_fluid = ask_interface(processes[0]);
  solid_.emplace(processes[1]);
  fluid_.emplace(processes[0], map_of(master.coupling, of_fluid, interface_));
  const CouplingOptions options{master.coupling.tolerance, master.coupling.max_iterations, master.coupling.reuse,
                                size_};
  coupling_ = make_coupling(master.coupling.method, *fluid_, *solid_, options);
  if (measurements() == nullptr) return;
  observation_.emplace(*measurements());
  const ObserverCase& observer = master.file.common().observer;
  if (observer.is_on()) observer_ = make_observer(observer, *observation_, *fluid_, *solid_, interface_.points);
}

Crew CoupledCodes::crew() {
  return {*fluid_,
          *solid_,
          *coupling_,
          interface_.points,
          processes_[0].hello().observables,
          processes_[1].hello().observables,
          observer_.get()};
}

std::vector<protocol::Program> programs_of(const MasterCase& master, bool with_measurements) {
  const auto& programs = master.coupling.programs;
  std::vector<protocol::Program> all{partner_program("fluid", "fluid", programs.fluid, master.file),
                                     partner_program("solid", "solid", programs.solid, master.file)};
  if (with_measurements)
    all.push_back(partner_program("solid_observation", "observation", programs.observation, master.file));
  return all;
}

}  // namespace tether
