#include "tests/scenarios/coupled_vessel.hpp"

#include "common/config/case_file.hpp"
#include "fluid/case.hpp"
#include "fluid/server.hpp"
#include "fsi_master/coupling_case.hpp"
#include "solid/case.hpp"
#include "solid/server.hpp"
#include "tests/protocol/in_process.hpp"
#include "vessel/mesh_case.hpp"

namespace tether {

/// All sections of a case.
struct WholeCase {
  explicit WholeCase(const std::filesystem::path& path) : file(path) {
    file.read("mesh", mesh);
    file.read("fluid", fluid);
    file.read("solid", solid);
    file.read("coupling", coupling);
    file.finish();
  }
  VesselMesh vessel() const {
    return load_mesh(mesh, file, solid.element == "p1" ? WallElement::p1 : WallElement::prism);
  }
  CaseFile file;
  MeshCase mesh;
  fluid::FluidCase fluid;
  SolidCase solid;
  CouplingCase coupling;
};

namespace {

protocol::Partner fluid_of(const WholeCase& all, const fluid::FluidSolver*& blood) {
  auto solver = std::make_unique<fluid::FluidSolver>(all.vessel().fluid, fluid::make_settings(all.fluid, all.file));
  blood = solver.get();
  return protocol::in_process_partner<protocol::ToObservedFluid>(
      "fluid", std::make_shared<fluid::FluidServer>(std::move(solver), all.file.units(), "{}", ""));
}

protocol::Partner solid_of(const WholeCase& all) {
  return protocol::in_process_partner<protocol::ToObservedSolid>(
      "solid",
      std::make_shared<SolidServer>(prepare_wall(all.solid, all.vessel().wall, all.file), all.file.units(), "{}", ""));
}

}  // namespace

CoupledVessel::CoupledVessel(const std::filesystem::path& case_file) : CoupledVessel(WholeCase(case_file)) {}

CoupledVessel::CoupledVessel(const WholeCase& all)
    : dt_(all.file.common().time.step),
      steps_of_case_(all.file.common().time.steps()),
      fluid_process_(fluid_of(all, blood_)),
      solid_process_(solid_of(all)),
      surface_(ask_interface(solid_process_)),
      solid_(solid_process_) {
  const double size = diagonal(surface_.points);
  fluid_.emplace(fluid_process_,
                 InterfaceMap::match(ask_interface(fluid_process_), surface_, 1e-5 * size, UnitSystem::cgs()));
  options_ = {all.coupling.tolerance, all.coupling.max_iterations, all.coupling.reuse, size};
  coupling_ = make_coupling(all.coupling.method, *fluid_, solid_, options_);
  loop_.emplace(*fluid_, solid_, *coupling_, surface_.points.reshaped(), all.coupling.halvings);
}

const StepRecord& CoupledVessel::advance() {
  last_ = loop_->advance(step_ + 1, time(), dt_);
  ++step_;
  return last_;
}

CoupledVessel::Effort CoupledVessel::advance(int steps) {
  Effort sum;
  for (int n = 0; n < steps; ++n) {
    advance();
    sum.evaluations += last_.evaluations;
    sum.krylov_iterations += last_.krylov_iterations;
  }
  return {sum.evaluations / steps, sum.krylov_iterations / steps};
}

double CoupledVessel::of_fluid(const std::string& observable) {
  const auto& infos = fluid_process_.hello().observables;
  for (std::size_t i = 0; i < infos.size(); ++i)
    if (infos[i].name == observable) return last_.fluid[i];
  throw run_error("the fluid reports no {}", observable);
}

Points CoupledVessel::displacement() const {
  return Eigen::Map<const Points>(loop_->displacement().data(), 3, surface_.points.cols());
}

VectorXd CoupledVessel::velocity() {
  const std::vector<double> V = loop_->snapshot().velocity;
  return Eigen::Map<const VectorXd>(V.data(), static_cast<Eigen::Index>(V.size()));
}

void CoupledVessel::observe(ObservationPartner& data, Observer::Form form) {
  observer_.emplace(data, *fluid_, solid_, form, surface_.points.reshaped());
  loop_->observe(*observer_);
}

void CoupledVessel::correct_once(ObservationPartner& data, double duration) {
  Observer once(data, *fluid_, solid_, Observer::Form::split, surface_.points.reshaped());
  Snapshot snapshot = loop_->snapshot();
  const VectorXd change = once.correct(time(), duration, loop_->displacement());
  snapshot.fluid = fluid_->state().get();
  snapshot.solid = solid_.state().get();
  for (std::size_t i = 0; i < snapshot.displacement.size(); ++i)
    snapshot.displacement[i] += change[static_cast<Eigen::Index>(i)];
  loop_->restore(snapshot);
}

void CoupledVessel::stand_where(CoupledVessel& other) {
  Snapshot there = other.loop_->snapshot();
  there.method = "another's";
  loop_->restore(there);
  step_ = other.step_;
}

}  // namespace tether
