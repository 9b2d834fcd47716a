#include "fsi_master/group_server.hpp"

#include <algorithm>
#include <filesystem>

#include "common/base/checked_file.hpp"
#include "common/base/error.hpp"
#include "common/base/process.hpp"
#include "common/base/write_error.hpp"
#include "fsi_master/run_guide.hpp"
#include "fsi_master/summary.hpp"
#include "fsi_master/untold.hpp"

namespace tether {
namespace {

using protocol::Partner;

/// A partner's parameter or observable among those of both: "solid.density".
std::string full_name(const Partner& partner, const std::string& name) {
  const std::string prefix = partner.role() + ".";
  return name.starts_with(prefix) ? name : prefix + name;
}

std::unique_ptr<TimeLoop> make_loop(CoupledCodes& codes, int halvings) {
  const Crew crew = codes.crew();
  auto loop = std::make_unique<TimeLoop>(crew.fluid, crew.solid, crew.coupling, crew.interface.reshaped(), halvings);
  if (crew.observer != nullptr) loop->observe(*crew.observer);
  return loop;
}

protocol::SetParameters announced(Partner& partner) {
  protocol::SetParameters all;
  for (const auto& info : partner.hello().parameters) all.names.push_back(info.name), all.values.push_back(info.value);
  return all;
}

/// Takes the values of `some` over into `all`, which has their names.
void adopt(const protocol::SetParameters& some, protocol::SetParameters& all) {
  for (std::size_t i = 0; i < some.names.size(); ++i) {
    const auto place = std::find(all.names.begin(), all.names.end(), some.names[i]) - all.names.begin();
    all.values[static_cast<std::size_t>(place)] = some.values[i];
  }
}

void append(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// None if the run is asked for without one.
std::unique_ptr<RunGuide> guide_of(const protocol::Simulate& m, double dt) {
  if (m.guide.empty()) return nullptr;
  const auto role = m.guide == m.output ? RunGuide::Role::guide : RunGuide::Role::follower;
  return std::make_unique<RunGuide>(m.guide, role, dt);
}

/// The plan with the state that the case begins with.
RunPlan beginning(RunPlan plan, const MasterCase& master, const CoupledCodes& codes) {
  plan.origin = origin_of(master.file, codes.interface().points, 0);
  if (master.initial_state) plan.initial = initial_state_of(*master.initial_state, master.file, plan.origin);
  return plan;
}

/// Runs that begin elsewhere are others.
std::string begun_from(const Snapshot& state) {
  const std::uint64_t hash = hash_values(state.solid, hash_values(state.fluid, 0));
  return fmt::format(R"({{"begun_from": {{"state": "{:x}"}}}})", hash);
}

/// Where runs record the velocity: others, of the same codes, do not show what was measured.
std::string recorded_points(const Points& points) {
  return fmt::format(R"({{"recorded": {{"velocity_points": "{:x}"}}}})", hash_values(points, 0));
}

}  // namespace

GroupServer::GroupServer(std::unique_ptr<MasterCase> master, RunPlan plan, std::span<Partner> processes)
    : master_(std::move(master)),
      codes_(std::make_unique<CoupledCodes>(*master_, processes)),
      plan_(beginning(std::move(plan), *master_, *codes_)),
      loop_(make_loop(*codes_, master_->coupling.halvings)),
      present_{announced(processes[0]), announced(processes[1])} {
  if (plan_.initial) plan_.initial->put(*loop_);
  initial_ = loop_->snapshot();
}

protocol::Hello GroupServer::hello() const {
  protocol::Hello hello;
  hello.program = "fsi_master " TETHER_VERSION;
  hello.has_state = codes_->fluid().has_state() && codes_->solid().has_state();
  hello.state_size = static_cast<std::int64_t>(packed(initial_).size());
  std::vector<std::string> cases;
  for (Partner& partner : codes_->processes()) {
    const protocol::Hello& of_partner = partner.hello();
    hello.unknowns += of_partner.unknowns;
    hello.notices.insert(hello.notices.end(), of_partner.notices.begin(), of_partner.notices.end());
    if (&partner == codes_->measurements()) continue;
    cases.push_back(of_partner.effective_case);
    for (protocol::ParameterInfo info : of_partner.parameters) {
      info.name = full_name(partner, info.name);
      hello.parameters.push_back(std::move(info));
    }
    for (const protocol::ObservableInfo& info : of_partner.observables)
      hello.observables.push_back({partner.role() + "." + info.name, info.unit});
  }
  cases.push_back(untold_json(*master_, codes_->processes()));
  if (const OutputCase& output = master_->file.common().output; !output.points.empty())
    cases.push_back(followed_json(output));
  if (plan_.velocity_points.cols() > 0) cases.push_back(recorded_points(plan_.velocity_points));
  if (plan_.initial) {
    cases.push_back(begun_from(plan_.initial->snapshot));
    hello.notices.push_back(plan_.initial->notice);
  }
  hello.effective_case = merged_json(cases);
  return hello;
}

/// Of the code whose nodes results tell of.
protocol::Interface GroupServer::operator()(const protocol::GetInterface& m) {
  return codes_->processes()[codes_->lumen().map == nullptr ? 1 : 0].ask(m);
}

std::array<protocol::SetParameters, 2> GroupServer::divided(const protocol::SetParameters& all) const {
  if (all.names.size() != all.values.size())
    throw input_error("{} names of parameters, but {} values", all.names.size(), all.values.size());
  std::array<protocol::SetParameters, 2> parts;
  for (std::size_t i = 0; i < all.names.size(); ++i) {
    bool known = false;
    for (std::size_t k = 0; k < 2; ++k)
      for (const auto& info : codes_->processes()[k].hello().parameters)
        if (full_name(codes_->processes()[k], info.name) == all.names[i]) {
          parts[k].names.push_back(info.name);
          parts[k].values.push_back(all.values[i]);
          known = true;
        }
    if (!known) throw input_error("neither fluid nor solid has a parameter {}", all.names[i]);
  }
  return parts;
}

/// A value that the solid refuses leaves the fluid as it was too.
protocol::Ready GroupServer::operator()(const protocol::SetParameters& m) {
  const auto parts = divided(m);
  if (!parts[0].names.empty()) codes_->processes()[0].ask(parts[0]);
  try {
    if (!parts[1].names.empty()) codes_->processes()[1].ask(parts[1]);
  } catch (const std::exception&) {
    if (!parts[0].names.empty()) codes_->processes()[0].ask(present_[0]);
    throw;
  }
  for (std::size_t k = 0; k < 2; ++k) adopt(parts[k], present_[k]);
  return {};
}

protocol::State GroupServer::operator()(const protocol::GetState&) {
  return {packed(loop_->snapshot())};
}

protocol::Ready GroupServer::operator()(const protocol::SetState& m) {
  restore(m.values, {});
  return {};
}

/// Ends with displacement and velocity of the lumen that results tell of: where that is not the solid's interface, as
/// they follow from it.
std::vector<double> GroupServer::packed(const Snapshot& snapshot) const {
  std::vector<double> all = snapshot.fluid;
  append(all, snapshot.solid);
  append(all, snapshot.displacement);
  append(all, snapshot.velocity);
  if (codes_->lumen().map == nullptr) return all;
  for (const std::vector<double>* at_solid : {&snapshot.displacement, &snapshot.velocity}) {
    const VectorXd told =
        codes_->lumen().of(Eigen::Map<const VectorXd>(at_solid->data(), static_cast<Eigen::Index>(at_solid->size())));
    all.insert(all.end(), told.begin(), told.end());
  }
  return all;
}

void GroupServer::restore(const std::vector<double>& state, const std::vector<double>& memory) {
  Snapshot snapshot = initial_;
  auto from = state.begin();
  for (std::vector<double>* part : {&snapshot.fluid, &snapshot.solid, &snapshot.displacement, &snapshot.velocity}) {
    if (state.end() - from < static_cast<std::ptrdiff_t>(part->size()))
      throw run_error("a state of {} numbers is too short for this vessel", state.size());
    std::copy_n(from, part->size(), part->begin());
    from += static_cast<std::ptrdiff_t>(part->size());
  }
  const std::ptrdiff_t told = codes_->lumen().map == nullptr ? 0 : 2 * codes_->lumen().points.size();
  if (state.end() - from != told)
    throw run_error("a state of {} numbers is too {} for this vessel", state.size(),
                    state.end() - from < told ? "short" : "long");
  if (!memory.empty()) snapshot.coupling = memory;
  loop_->restore(snapshot);
}

protocol::Advanced GroupServer::operator()(const protocol::Advance& m) {
  if (!m.state.empty()) restore(m.state, m.memory);
  (*this)(protocol::SetParameters{m.names, m.values});
  const StepRecord record = loop_->advance(m.step, m.time, m.dt);
  const Snapshot after = loop_->snapshot();
  protocol::Advanced reply;
  reply.state = packed(after);
  reply.memory = after.coupling;
  reply.observables = record.fluid;
  append(reply.observables, record.solid);
  reply.evaluations = record.evaluations;
  reply.krylov_iterations = record.krylov_iterations;
  reply.parts = record.parts;
  if (m.observe) observe(m.time + m.dt, reply);
  return reply;
}

void GroupServer::observe(double time, protocol::Advanced& reply) {
  if (plan_.velocity_points.cols() > 0) {
    const Points velocity = codes_->fluid().velocity_at(plan_.velocity_points).get();
    reply.velocities.assign(velocity.data(), velocity.data() + velocity.size());
  }
  if (codes_->measurements() == nullptr) return;
  const ToldLumen& lumen = codes_->lumen();
  const VectorXd x = lumen.points.reshaped() + lumen.of(loop_->displacement());
  protocol::Discrepancy seen = codes_->measurements()->ask(protocol::Observe{time, {x.begin(), x.end()}});
  reply.distances = std::move(seen.distances);
  reply.weights = std::move(seen.weights);
}

namespace {

/// A coupling follows the guide of a run for as long as there is one, however the run ends.
class Following {
 public:
  Following(Coupling& coupling, RunGuide* guide) : coupling_(coupling) { coupling_.follow(guide); }
  ~Following() { coupling_.follow(nullptr); }
  Following(const Following&) = delete;
  Following& operator=(const Following&) = delete;

 private:
  Coupling& coupling_;
};

}  // namespace

protocol::Simulated GroupServer::operator()(const protocol::Simulate& m) {
  loop_->restore(initial_);
  (*this)(protocol::SetParameters{m.names, m.values});
  RunPlan plan = plan_;
  plan.output = m.output;
  plan.write_series = false;  // the codes of all groups have one folder
  plan.last_step = m.steps;
  make_folders_below(std::filesystem::absolute(master_->file.path()).parent_path(), plan.output);  // as in a diagnosis
  const auto guide = guide_of(m, plan.dt);
  const Following following(codes_->coupling(), guide.get());
  Simulation simulation(plan, codes_->crew(), master_->coupling.halvings);
  protocol::Simulated reply;
  try {
    simulation.begin();
    simulation.run();
  } catch (const StepFailure& failure) {  // these values are too much for the model; others may not be
    reply.failure = failure.what();
  }
  reply.evaluations = static_cast<std::int64_t>(simulation.statistics().evaluations.sum);
  loop_->restore(initial_);
  return reply;
}

protocol::Ready GroupServer::operator()(const protocol::Write& m) {
  for (Partner& partner : codes_->processes().first(2)) partner.ask(m);
  return {};
}

protocol::Usage GroupServer::operator()(const protocol::GetUsage& m) {
  protocol::Usage all{cpu_seconds(), peak_memory_mb()};
  for (Partner& partner : codes_->processes()) {
    if (partner.is_here()) continue;
    const auto usage = partner.ask(m);
    all.cpu_seconds += usage.cpu_seconds;
    all.peak_memory_mb += usage.peak_memory_mb;
  }
  return all;
}

}  // namespace tether
