#include "common/protocol/conform.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <thread>

#include "common/protocol/excitation.hpp"
#include "common/protocol/watch.hpp"

namespace tether::protocol {

namespace {

constexpr double repeat_tolerance = 1e-8;    // the same evaluation twice, or after a rejected step
constexpr double tangent_tolerance = 1e-3;   // against central differences
constexpr double symmetry_tolerance = 1e-8;  // of the solid's operators

/// Thrown by a check that found something wrong, or has nothing to look at.
struct Broken : RunError {
  using RunError::RunError;
};
struct Skipped : RunError {
  using RunError::RunError;
};

template <class... Args>
void require(bool condition, fmt::format_string<Args...> format, Args&&... args) {
  if (!condition) throw Broken(fmt::format(format, std::forward<Args>(args)...));
}

bool all_finite(const Numbers& values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

/// The checks, each a function that returns what it measured. They run in this order and build on each other.
class Examiner {
 public:
  Examiner(Partner& partner, double dt) : partner_(partner), dt_(dt) {}
  std::vector<Check> run();

 private:
  using Body = std::string (Examiner::*)();
  /// False if the partner is gone.
  bool check(const std::string& name, Body body);
  void rest();  ///< leaves a step that a failed check left open

  std::string hello();
  std::string surface();
  std::string orientation();
  std::string evaluate();
  std::string repeat();
  std::string reject();
  std::string accept();
  std::string tangent();
  std::string velocity();
  std::string operators();
  std::string operator_derivative();
  std::string state();
  std::string parameters();
  std::string wrong_sizes();
  std::string unknown_requests();
  std::string usage();
  std::string stop();

  Numbers begin_and_evaluate(double amplitude) {
    drive_->begin();
    in_step_ = true;
    return drive_->evaluate(amplitude);
  }
  StepReport end(bool accepted) {
    in_step_ = false;
    return drive_->end(accepted);
  }
  Numbers unknowns(double phase) const;
  /// Throws Broken unless the partner answers Failure.
  template <class Request>
  void expect_failure(const Request& request, const std::string& what);

  Partner& partner_;
  double dt_;
  std::vector<Check> checks_;
  Interface surface_;
  std::optional<Excitation> drive_;
  bool in_step_ = false;
};

std::vector<Check> Examiner::run() {
  const std::vector<std::pair<const char*, Body>> all{
      {"says hello", &Examiner::hello},
      {"interface is a surface", &Examiner::surface},
      {"normals point out of the fluid", &Examiner::orientation},
      {"a step can be evaluated", &Examiner::evaluate},
      {"the same evaluation again gives the same", &Examiner::repeat},
      {"a rejected step leaves no trace", &Examiner::reject},
      {"an accepted step reports its observables", &Examiner::accept},
      {"tangent is the derivative of the evaluation", &Examiner::tangent},
      {"tells its velocity inside, and none outside", &Examiner::velocity},
      {"operators are symmetric", &Examiner::operators},
      {"product is the derivative of the residual", &Examiner::operator_derivative},
      {"a state set again continues bit for bit", &Examiner::state},
      {"parameters can be set, unknown ones are refused", &Examiner::parameters},
      {"arrays of a wrong size are refused", &Examiner::wrong_sizes},
      {"unknown requests are refused", &Examiner::unknown_requests},
      {"reports its cost", &Examiner::usage},
      {"stops when told", &Examiner::stop}};
  for (const auto& [name, body] : all)
    if (!check(name, body)) break;
  return checks_;
}

bool Examiner::check(const std::string& name, Body body) {
  using enum Check::Result;
  try {
    checks_.push_back({name, passed, (this->*body)()});
    return true;
  } catch (const Skipped& reason) {
    checks_.push_back({name, skipped, reason.what()});
    return true;
  } catch (const PeerDied& death) {
    checks_.push_back({name, failed, death.what()});
    return false;
  } catch (const std::exception& error) {
    checks_.push_back({name, failed, error.what()});
  }
  rest();
  return drive_.has_value();
}

void Examiner::rest() {
  if (!in_step_ || !partner_.is_idle()) return;
  try {
    end(false);
  } catch (const std::exception&) {
    // The next check that needs a step will say what is wrong.
  }
}

template <class Request>
void Examiner::expect_failure(const Request& request, const std::string& what) {
  try {
    partner_.ask(request);
  } catch (const PartnerFailed&) {
    return;
  } catch (const InputError&) {
    return;
  }
  throw Broken(what + " was accepted");
}

std::string Examiner::hello() {
  const Hello& hello = partner_.hello();
  require(!hello.program.empty(), "the program has no name");
  require(!hello.has_state || hello.state_size > 0, "announces states of size {}", hello.state_size);
  require(!hello.has_operators || hello.unknowns > 0, "announces operators for {} unknowns", hello.unknowns);
  std::set<std::string> names;
  for (const auto& p : hello.parameters) {
    require(!p.name.empty() && names.insert(p.name).second, "the parameter name \"{}\" is empty or not unique", p.name);
    require(p.value >= p.lower && p.value <= p.upper, "parameter {}: {} is not in [{}, {}]", p.name, p.value, p.lower,
            p.upper);
  }
  return fmt::format("{}: {}, {} parameters, {} observables", partner_.role(), hello.program, hello.parameters.size(),
                     hello.observables.size());
}

std::string Examiner::surface() {
  surface_ = partner_.ask(GetInterface{});
  const auto nodes = static_cast<std::int64_t>(surface_.points.size() / 3);
  const std::size_t triangles = surface_.triangles.size() / 3;
  require(nodes >= 3 && surface_.points.size() % 3 == 0, "{} coordinates", surface_.points.size());
  require(triangles > 0 && surface_.triangles.size() % 3 == 0, "{} triangle corners", surface_.triangles.size());
  require(all_finite(surface_.points), "a coordinate is not finite");
  std::vector<bool> used(static_cast<std::size_t>(nodes));
  for (const std::int64_t corner : surface_.triangles) {
    require(corner >= 0 && corner < nodes, "a triangle has the node {}, there are {}", corner, nodes);
    used[static_cast<std::size_t>(corner)] = true;
  }
  require(std::find(used.begin(), used.end(), false) == used.end(), "node {} belongs to no triangle",
          std::find(used.begin(), used.end(), false) - used.begin());
  const auto& regions = surface_.regions;
  require(regions.empty() || regions.size() == triangles, "{} regions for {} triangles", regions.size(), triangles);
  for (const std::int64_t region : regions)
    require(region >= -1 && region < static_cast<std::int64_t>(surface_.region_names.size()), "region {} has no name",
            region);
  drive_.emplace(partner_, surface_, dt_);
  return fmt::format("{} nodes, {} triangles", nodes, triangles);
}

std::string Examiner::orientation() {
  std::map<std::pair<std::int64_t, std::int64_t>, int> edges;
  for (std::size_t i = 0; i < surface_.triangles.size(); ++i) {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    const auto edge = std::pair(surface_.triangles[i], surface_.triangles[next]);
    require(++edges[edge] == 1, "two triangles run from node {} to node {}: they look to opposite sides", edge.first,
            edge.second);
  }
  const double outwardness = Shape(surface_).outwardness;
  require(outwardness > 0, "the triangles look inward");
  return "";
}

std::string Examiner::evaluate() {
  drive_->calibrate();
  const Numbers response = begin_and_evaluate(1);
  drive_->evaluate(0);  // at rest, where a run begins
  end(false);
  const std::size_t expected = surface_.points.size() * (partner_.role() == "fluid" ? 1 : 2);
  require(response.size() == expected, "the reply has {} numbers instead of {}", response.size(), expected);
  require(all_finite(response), "the reply is not finite");
  return fmt::format("largest entry {:.3g} for an excitation of {:.3g}", largest(response),
                     largest(drive_->excitation(1)));
}

std::string Examiner::repeat() {
  const Numbers first = begin_and_evaluate(1);
  drive_->evaluate(0.5);
  const double change = difference(first, drive_->evaluate(1));
  end(false);
  require(change <= repeat_tolerance, "relative difference {:.2g} > {:.0g}", change, repeat_tolerance);
  return fmt::format("relative difference {:.2g}", change);
}

std::string Examiner::reject() {
  const Numbers first = begin_and_evaluate(1);
  drive_->evaluate(-1);
  end(false);
  const double change = difference(first, begin_and_evaluate(1));
  end(false);
  drive_->begin();
  end(false);  // without any evaluation
  require(change <= repeat_tolerance, "relative difference {:.2g} > {:.0g}", change, repeat_tolerance);
  return fmt::format("relative difference {:.2g}", change);
}

std::string Examiner::accept() {
  begin_and_evaluate(1);
  const StepReport report = end(true);
  const std::size_t announced = partner_.hello().observables.size();
  require(report.observables.size() == announced, "{} observables announced, {} reported", announced,
          report.observables.size());
  require(all_finite(report.observables), "an observable is not finite");
  begin_and_evaluate(1.1);
  end(true);
  return "";
}

std::string Examiner::tangent() {
  if (!partner_.hello().has_tangent) throw Skipped("not announced");
  constexpr double h = 0.01;
  begin_and_evaluate(1);
  const Numbers up = drive_->evaluate(1, h), down = drive_->evaluate(1, -h);
  drive_->evaluate(1);
  const Numbers change = drive_->tangent();
  end(false);
  require(change.size() == up.size(), "the reply has {} numbers instead of {}", change.size(), up.size());
  const Numbers expected = combined(0.5 / h, up, -0.5 / h, down);
  const double error = difference(change, expected);
  require(error <= tangent_tolerance, "relative error {:.2g} > {:.0g}", error, tangent_tolerance);
  return fmt::format("relative error {:.2g}", error);
}

Numbers Examiner::unknowns(double phase) const {
  Numbers values(static_cast<std::size_t>(partner_.hello().unknowns));
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(phase + 0.37 * static_cast<double>(i * i % 101));
  return values;
}

/// At a place beneath each triangle of the interface, a twentieth of its size deep; and far away.
std::string Examiner::velocity() {
  if (partner_.role() != "fluid") throw Skipped("is no fluid");
  Numbers places = beneath(surface_);
  const std::size_t inside = places.size();
  for (const double far : {1e6, 1e6, 1e6}) places.push_back(far);
  Numbers found;
  try {
    found = partner_.ask(GetVelocity{places}).values;
  } catch (const PartnerFailed&) {
    throw Skipped("does not tell its velocity");
  }
  require(found.size() == places.size(), "{} numbers instead of {}", found.size(), places.size());
  require(all_finite({found.begin(), found.begin() + static_cast<std::ptrdiff_t>(inside)}), "none in the lumen");
  for (std::size_t i = inside; i < found.size(); ++i) require(std::isnan(found[i]), "one outside the lumen");
  return fmt::format("{} places", inside / 3);
}

std::string Examiner::operators() {
  if (!partner_.hello().has_operators) throw Skipped("not announced");
  drive_->begin();
  in_step_ = true;
  partner_.ask(SolidResidual{{}, drive_->excitation(1)});
  const Numbers a = unknowns(0.1), b = unknowns(1.7);
  const Numbers ka = partner_.ask(SolidProduct{a}).values, kb = partner_.ask(SolidProduct{b}).values;
  const Numbers pa = partner_.ask(SolidPrecondition{a}).values, pb = partner_.ask(SolidPrecondition{b}).values;
  end(false);
  for (const Numbers* reply : {&ka, &kb, &pa, &pb})
    require(reply->size() == a.size(), "a reply has {} numbers instead of {}", reply->size(), a.size());
  const auto asymmetry = [&](const Numbers& xa, const Numbers& xb) {
    return std::abs(dot(a, xb) - dot(b, xa)) / std::sqrt(std::abs(dot(a, xa) * dot(b, xb)));
  };
  require(dot(a, ka) > 0 && dot(b, kb) > 0, "the product is not positive");
  require(asymmetry(ka, kb) <= symmetry_tolerance, "product: asymmetry {:.2g}", asymmetry(ka, kb));
  require(asymmetry(pa, pb) <= symmetry_tolerance, "preconditioner: asymmetry {:.2g}", asymmetry(pa, pb));
  return fmt::format("asymmetry {:.2g} and {:.2g}", asymmetry(ka, kb), asymmetry(pa, pb));
}

std::string Examiner::operator_derivative() {
  if (!partner_.hello().has_operators) throw Skipped("not announced");
  const Numbers load = drive_->excitation(1);
  drive_->begin();
  in_step_ = true;
  const SolidResidualReply start = partner_.ask(SolidResidual{{}, load});
  // One preconditioned correction is a direction of the right size.
  Numbers direction = partner_.ask(SolidPrecondition{start.residual}).values;
  direction = combined(0.01, direction, 0, direction);
  const Numbers product = partner_.ask(SolidProduct{direction}).values;
  const SolidResidualReply up = partner_.ask(SolidResidual{direction, load});
  const SolidResidualReply down = partner_.ask(SolidResidual{combined(-2, direction, 0, direction), load});
  end(false);
  const double error = difference(product, combined(-0.5, up.residual, 0.5, down.residual));
  require(error <= tangent_tolerance, "relative error {:.2g} > {:.0g}", error, tangent_tolerance);
  Numbers moved = combined(1 / dt_, up.displacement, -1 / dt_, down.displacement);
  const double kinematics = difference(moved, combined(1, up.velocity, -1, down.velocity));
  require(kinematics <= 1e-6, "displacement and dt times velocity differ by {:.2g}", kinematics);
  return fmt::format("relative error {:.2g}", error);
}

std::string Examiner::state() {
  if (!partner_.hello().has_state) throw Skipped("not announced: can be simulated, but not identified");
  const State saved = partner_.ask(GetState{});
  require(static_cast<std::int64_t>(saved.values.size()) == partner_.hello().state_size,
          "{} numbers announced, {} given", partner_.hello().state_size, saved.values.size());
  require(all_finite(saved.values), "the state is not finite");
  const auto continued = [this] {
    const Numbers response = begin_and_evaluate(0.8);
    end(true);
    return response;
  };
  const Excitation here = *drive_;
  const Numbers first = continued();
  const State after = partner_.ask(GetState{});
  partner_.ask(SetState{saved.values});
  require(partner_.ask(GetState{}).values == saved.values, "a state set is not the state got");
  drive_.emplace(here);
  const Numbers second = continued();
  require(first == second, "the step after it differs by {:.2g}", difference(first, second));
  require(partner_.ask(GetState{}).values == after.values, "the state after the step differs");
  return fmt::format("{} numbers", saved.values.size());
}

std::string Examiner::parameters() {
  const auto& announced = partner_.hello().parameters;
  for (const auto& p : announced) partner_.ask(SetParameters{{p.name}, {p.value}});
  expect_failure(SetParameters{{"no such parameter"}, {1.0}}, "an unknown name");
  partner_.ask(GetInterface{});
  return fmt::format("{}", announced.size());
}

std::string Examiner::wrong_sizes() {
  drive_->begin();
  in_step_ = true;
  Numbers wrong = drive_->excitation(0);
  wrong.pop_back();
  if (partner_.role() == "fluid")
    expect_failure(FluidEvaluate{wrong, wrong}, "a motion of a wrong size");
  else
    expect_failure(SolidEvaluate{wrong}, "a load of a wrong size");
  end(false);
  if (partner_.hello().has_state) expect_failure(SetState{{}}, "an empty state");
  return "";
}

std::string Examiner::unknown_requests() {
  if (partner_.role() == "fluid")
    expect_failure(SolidEvaluate{drive_->excitation(1)}, "a request to a solid");
  else
    expect_failure(FluidTangent{drive_->excitation(1)}, "a request to a fluid");
  partner_.ask(GetInterface{});
  return "";
}

std::string Examiner::usage() {
  const Usage usage = partner_.ask(GetUsage{});
  require(usage.cpu_seconds >= 0 && usage.peak_memory_mb > 0, "{} s, {} MB", usage.cpu_seconds, usage.peak_memory_mb);
  return fmt::format("{:.2g} s, {:.3g} MB", usage.cpu_seconds, usage.peak_memory_mb);
}

std::string Examiner::stop() {
  const Peer peer = partner_.peer();
  partner_.finish({"the check is over"}, 10);
  partner_.close();
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [start] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  while (peer.pid != 0 && !is_dead(peer) && seconds() < 5) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  require(peer.pid == 0 || is_dead(peer) || peer.host.empty(), "it still runs after 5 s");
  return "";
}

}  // namespace

std::vector<Check> conform(Partner& partner, double dt) {
  return Examiner(partner, dt).run();
}

std::string table_of(const std::vector<Check>& checks) {
  std::string table;
  for (const Check& check : checks) {
    const char* word = check.result == Check::Result::passed   ? "PASS"
                       : check.result == Check::Result::failed ? "FAIL"
                                                               : "skip";
    table += fmt::format("{}  {:<48}{}{}\n", word, check.name, check.detail.empty() ? "" : "  ", check.detail);
  }
  return table;
}

bool all_passed(const std::vector<Check>& checks) {
  return std::none_of(checks.begin(), checks.end(), [](const Check& c) { return c.result == Check::Result::failed; });
}

}  // namespace tether::protocol
