#include "fsi_master/coupled_codes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "common/base/error.hpp"
#include "common/base/transform.hpp"

namespace tether {
namespace {

/// What "automatic" stands for.
std::string mapping_of(const CouplingCase& coupling, const InterfaceSurface& fluid, const InterfaceSurface& solid) {
  if (coupling.mapping != "automatic") return coupling.mapping;
  return InterfaceMap::matches(fluid, solid, same_node * diagonal(solid.points)) ? "match" : "mortar";
}

InterfaceMap map_of(const std::string& mapping, const CouplingCase& coupling, const InterfaceSurface& fluid,
                    const InterfaceSurface& solid, const UnitSystem& units) {
  const double size = diagonal(solid.points);
  if (mapping == "match")
    return InterfaceMap::match(fluid, solid, coupling.mapping_distance.value_or(same_node * size), units);
  const double trust = coupling.mapping_distance.value_or(trusted_distance * size);
  return mapping == "mortar" ? InterfaceMap::mortar(fluid, solid, trust, units)
                             : InterfaceMap::nearest_triangle(fluid, solid, trust, units);
}

/// `field`: of coupling.programs and coupling.ranks.
protocol::Program partner_program(const char* role, const std::string& field, const std::string& executable, int ranks,
                                  const CaseFile& file) {
  return {role,
          executable,
          {std::filesystem::absolute(file.path()).string()},
          ranks,
          file.where("coupling.programs." + field)};
}

/// Throws InputError for a name that is empty or announced twice: what is set or reported by it would be either's.
template <class Infos>
void check_names(const Infos& infos, const char* what, const protocol::Partner& partner) {
  std::set<std::string> names;
  for (const auto& info : infos)
    if (info.name.empty() || !names.insert(info.name).second)
      throw input_error("{} announces {} \"{}\"{}", partner.role(), what, info.name, info.name.empty() ? "" : " twice");
}

/// Throws InputError for a number that an identification could not move: of no known transform, or outside its own
/// limits.
void check_numbers(protocol::Partner& partner) {
  for (const protocol::ParameterInfo& info : partner.hello().parameters) {
    try {
      static_cast<void>(transform_named(info.transform));
    } catch (const InputError& error) {
      throw input_error("{} announces {}: {}", partner.role(), info.name, error.what());
    }
    if (info.value < info.lower || info.value > info.upper)
      throw input_error("{} announces {} as {:g}, outside its own limits, {:g} and {:g}", partner.role(), info.name,
                        info.value, info.lower, info.upper);
  }
}

/// Throws InputError if the case says of a number that a code of somebody else's announces another value than the code:
/// it does not read that place, and what is identified would be lost there.
void check_is_read(protocol::Partner& partner, const std::string& executable, const CaseFile& file) {
  if (protocol::is_own(executable)) return;
  for (const protocol::ParameterInfo& info : partner.hello().parameters) {
    const std::string field = partner.role() + "." + info.name, text = file.given(field);
    char* end = nullptr;
    const double said = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0') continue;  // nothing, or with a unit, which only the code can read
    if (std::abs(said - info.value) > 1e-6 * std::max(std::abs(said), std::abs(info.value)))
      throw input_error(
          "{}: {}: {}: {} announces {} as {}: it must read its numbers where the case has them "
          "(docs/couple-your-code.md)",
          file.where(field), field, text, partner.hello().program, info.name, info.value);
  }
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
    : processes_(processes),
      interface_(ask_interface(processes[1])),
      size_(diagonal(interface_.points)),
      units_(master.file.units()) {
  for (protocol::Partner& partner : processes) {
    check_names(partner.hello().parameters, "a parameter", partner);
    check_names(partner.hello().observables, "an observable", partner);
    check_numbers(partner);
  }
  check_is_read(processes[0], master.coupling.programs.fluid, master.file);
  check_is_read(processes[1], master.coupling.programs.solid, master.file);
  const InterfaceSurface of_fluid = ask_interface(processes[0]);
  solid_.emplace(processes[1], size_);
  mapping_ = mapping_of(master.coupling, of_fluid, interface_);
  fluid_.emplace(processes[0], map_of(mapping_, master.coupling, of_fluid, interface_, units_));
  lumen_ = protocol::is_own(master.coupling.programs.solid) ? ToldLumen{interface_.points}
                                                            : ToldLumen{of_fluid.points, &fluid_->map()};
  fit_ = interface_fit(of_fluid, interface_, master.coupling.mapping_distance.value_or(trusted_distance * size_));
  if (fit_.looks_away())
    throw input_error(
        "the interface triangles of {} and {} look to opposite sides: their normals must point out of the fluid",
        fluid_->name(), solid_->name());
  const CouplingOptions options{master.coupling.tolerance, master.coupling.max_iterations, master.coupling.reuse,
                                size_};
  coupling_ = make_coupling(master.coupling.method, *fluid_, *solid_, options);
  if (measurements() == nullptr) return;
  observation_.emplace(*measurements());
  const ObserverCase& observer = master.file.common().observer;
  if (observer.is_on()) observer_ = make_observer(observer, *observation_, *fluid_, *solid_, interface_.points);
}

InterfaceRecord CoupledCodes::interface_record() const {
  const InterfaceBalance& lost = fluid_->balance();
  return {.mapping = mapping_,
          .fluid_nodes = fit_.fluid_nodes,
          .wall_nodes = fit_.wall_nodes,
          .largest_gap_mm = units_.to_mm(fit_.largest_gap),
          .largest_overlap_mm = units_.to_mm(fit_.largest_overlap),
          .rms_distance_mm = units_.to_mm(fit_.rms_distance),
          .bare_share = fit_.bare_share(),
          .force_error = lost.force,
          .moment_error = lost.moment,
          .work_error = lost.work};
}

std::vector<std::string> CoupledCodes::interface_notices() const {
  std::vector<std::string> all;
  if (mapping_ != "match")
    all.push_back(fmt::format("the interfaces differ and are joined by {}: {}", mapping_, in_words(fit_, units_)));
  return all;
}

Crew CoupledCodes::crew() {
  return {*fluid_,
          *solid_,
          *coupling_,
          interface_.points,
          lumen_,
          processes_[0].hello().observables,
          processes_[1].hello().observables,
          observer_.get()};
}

std::vector<protocol::Program> programs_of(const MasterCase& master, bool with_measurements) {
  const auto& programs = master.coupling.programs;
  const auto& ranks = master.coupling.ranks;
  std::vector<protocol::Program> all{partner_program("fluid", "fluid", programs.fluid, ranks.fluid, master.file),
                                     partner_program("solid", "solid", programs.solid, ranks.solid, master.file)};
  if (with_measurements)
    all.push_back(partner_program("solid_observation", "observation", programs.observation, 1, master.file));
  return all;
}

}  // namespace tether
