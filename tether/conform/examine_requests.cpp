/// States, parameters, mistakes and the end.
#include <algorithm>
#include <chrono>
#include <thread>

#include "common/base/transform.hpp"
#include "common/protocol/watch.hpp"
#include "tether/conform/examiner.hpp"

namespace tether::protocol {

namespace {

constexpr const char* unknown_name = "no such parameter";

/// Another admissible value of a parameter; its own if there is none.
double other_value(const ParameterInfo& p) {
  for (const double value : {1.1 * p.value, 0.9 * p.value, p.value + 1, 0.5 * (p.lower + p.upper)})
    if (value != p.value && value > p.lower && value < p.upper) return value;
  return p.value;
}

}  // namespace

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

Numbers Examiner::tried_response() {
  Numbers response = begin_and_evaluate(1);
  end(false);
  return response;
}

std::string Examiner::parameters() {
  const auto& announced = partner_.hello().parameters;
  SetParameters own;
  for (const auto& p : announced) {
    static_cast<void>(transform_named(p.transform));
    partner_.ask(SetParameters{{p.name}, {p.value}});
    own.names.push_back(p.name), own.values.push_back(p.value);
  }
  SetParameters before{{unknown_name}, {1.0}}, after;  // the unknown name before the known ones, and after them
  expect_failure(before, "an unknown name");
  if (announced.empty()) return "0";
  for (const auto& p : announced)
    for (SetParameters* mixed : {&before, &after})
      mixed->names.push_back(p.name), mixed->values.push_back(other_value(p));
  after.names.emplace_back(unknown_name), after.values.push_back(1.0);
  const Numbers first = tried_response();
  const auto felt = std::count_if(announced.begin(), announced.end(), [&](const ParameterInfo& p) {
    partner_.ask(SetParameters{{p.name}, {other_value(p)}});
    const double change = difference(first, tried_response());
    partner_.ask(SetParameters{{p.name}, {p.value}});
    return change > 0;
  });
  require(felt > 0, "none of the {} changes what a step answers: are they set?", announced.size());
  const double kept = difference(first, tried_response());
  require(kept <= repeat_tolerance, "set again to what they were they answer otherwise: relative difference {:.2g}",
          kept);
  for (const SetParameters* mixed : {&before, &after}) {
    expect_failure(*mixed, "an unknown name among known ones");
    const double change = difference(first, tried_response());
    partner_.ask(own);
    require(change <= repeat_tolerance,
            "refused together with an unknown name, and yet set: relative difference {:.2g}", change);
  }
  return fmt::format("{}, {} of which change what a step answers", announced.size(), felt);
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
  require(usage.cpu_seconds >= 0 && usage.peak_memory_mb > 0,
          "CPU time {} s, memory {} MB: must be at least 0 and above 0", usage.cpu_seconds, usage.peak_memory_mb);
  return fmt::format("{:.2g} s, {:.3g} MB", usage.cpu_seconds, usage.peak_memory_mb);
}

std::string Examiner::stop() {
  const Peer peer = partner_.peer();
  partner_.finish({"the check is over"}, 10);
  partner_.close(exit_run_failed);
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [start] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  // The master leaves it to the reaper after 5 s; a busy machine is given more.
  while (peer.pid != 0 && !is_dead(peer) && seconds() < 30) std::this_thread::sleep_for(std::chrono::milliseconds(20));
  require(peer.pid == 0 || is_dead(peer) || peer.host.empty(), "it still runs after 30 s");
  return "";
}

}  // namespace tether::protocol
